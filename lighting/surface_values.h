// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/lit_mesh.h"
#include "lighting/local_pass.h"
#include "lighting/results.h"
#include "lighting/shown_mesh.h"
#include "lighting/solution.h"
#include "lighting/solution_errors.h"

namespace clerestory::lighting {

/// The solution as triangles with cell and point values, in model coordinates. Point values are means of the elements of one region of one
/// face side that meet there, each by its own line; they never reach across a contact, a crease or a material's edge. On a curved part they are means over all elements that meet at a point of
/// the limit surface where it is smooth: the irradiance of each belongs to its own plane, the mean of them to the limit's.
/// @param errors  of the solution
SurfaceResult surface_values(const Solution& solution, const SolutionErrors& errors);

/// The same, but surfaces that have a mesh of their own are shown by it, and points of curved parts are lit by the local pass.
SurfaceResult surface_values(const Solution& solution, const SolutionErrors& errors, const ShownMesh& shown,
                             const LitMesh& lit, const LocalPass& local, Progress& progress);

}  // namespace clerestory::lighting
