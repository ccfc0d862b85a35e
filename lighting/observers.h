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

/// The luminaires and surfaces that shine as an eye sees them, past what stands before them, with the counts of ObserverResult.
/// A luminaire's luminance is its intensity towards the eye by the area that its luminous opening shows there; what is hidden of it takes
/// its share off the solid angle. Surfaces that shine are seen by rays, even in solid angle.
/// @param view  local coordinates
std::vector<GlareSource> glare_sources(const Solution& solution, const View& view, ObserverResult& counts);

/// UGR of observers: the background is the indirect vertical illuminance at the eye by π. Windows are no luminaires: the sky in them counts
/// neither as glare nor as background.
/// @param observers  model coordinates
/// Source: CIE 117:1995.
std::vector<ObserverResult> observe(const Solution& solution, const SolutionErrors& errors,
                                    std::span<const Observer> observers, double accuracy, std::uint64_t seed,
                                    Progress& progress);

}  // namespace clerestory::lighting
