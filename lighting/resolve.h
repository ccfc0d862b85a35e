// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/radiosity.h"
#include "lighting/solution.h"
#include "lighting/stored_solution.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// Solves anew on stored links, for other reflectances, dimming and skies, without casting a ray: direct light by the stored light of
/// each source group, as much brighter or darker as the group has become. Errors by rays are taken to be as large in relation to the
/// light as they were; those of links follow from the new radiosities. They tell what links too coarse for the new light cost.
/// @param solution  fresh, of the same scene but for reflectances and the strength of sources, its groups told apart alike
/// Throws InputError where the two do not fit, and says what has changed.
Transport resolve(const StoredSolution& stored, Solution& solution, const Progress& progress);

}  // namespace clerestory::lighting
