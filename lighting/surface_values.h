// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/results.h"
#include "lighting/shadow_mesh.h"
#include "lighting/solution.h"
#include "lighting/solution_errors.h"
#include "lighting/straight_light.h"

namespace clerestory::lighting {

/// The solution as triangles with cell and point values, in model coordinates. Point values are means of the elements of one region of one
/// face side that meet there, each by its own line; they never reach across a contact, a crease or a material's edge. On a curved part they are means over all elements that meet at a point of
/// the limit surface where it is smooth: the irradiance of each belongs to its own plane, the mean of them to the limit's.
/// @param errors  of the solution
SurfaceResult surface_values(const Solution& solution, const SolutionErrors& errors);

/// The same, where shadows fall on a mesh with the lines of discontinuity in it: there what comes straight from sources is computed at each
/// point, and only the rest is the line of the solution's elements. Points are split at lines where light jumps.
SurfaceResult surface_values(const Solution& solution, const SolutionErrors& errors, const ShadowMesh& shadows,
                             const StraightLight& straight);

}  // namespace clerestory::lighting
