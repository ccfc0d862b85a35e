// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/relighting.h"
#include "lighting/solution.h"
#include "lighting/stored_solution.h"

namespace clerestory::lighting {

/// What it takes to solve anew on stored links: for other reflectances, dimming and skies without casting a ray, for another sun by that sun's
/// rays alone.
/// @param solution  fresh, of the same scene but for reflectances, the strength of sources, the sky and the sun; it must outlast the result
/// Throws InputError where the two do not fit, and says what has changed.
Relighting relighting_of(const StoredSolution& stored, Solution& solution);

}  // namespace clerestory::lighting
