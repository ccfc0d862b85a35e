// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lighting/glare.h"
#include "lighting/results.h"
#include "lighting/solution.h"
#include "lighting/solution_errors.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// UGR of observers: the background is the indirect vertical illuminance at the eye by π. Windows are no luminaires: the sky in them counts
/// neither as glare nor as background.
/// @param observers  model coordinates
/// Source: CIE 117:1995.
std::vector<ObserverResult> observe(const Solution& solution, const SolutionErrors& errors,
                                    std::span<const Observer> observers, double accuracy, std::uint64_t seed,
                                    Progress& progress);

}  // namespace clerestory::lighting
