// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/limit_surface.h"
#include "mesh/model.h"

/// Tiny control cages for tests. Metres, z up.
namespace clerestory::support {

/// A cube from -1 to 1 whose six quads share eight vertices, fronts outward; material and part "cage". Its Catmull-Clark surface is round.
mesh::Model cube_cage();

/// A cube as above whose top is cut into a pentagon and a triangle.
mesh::Model irregular_cage();

/// An octahedron with corners at distance 1, fronts outward, for Loop's scheme.
mesh::Model octahedron_cage();

/// All polygons of a model as one cage.
mesh::ControlCage whole_cage(const mesh::Model& model,
                             mesh::SubdivisionScheme scheme = mesh::SubdivisionScheme::kCatmullClark,
                             const mesh::SubdivisionRules& rules = {});

/// All parts of a model, curved.
mesh::Model curved(const mesh::Model& model, double chord_tolerance_m,
                   mesh::SubdivisionScheme scheme = mesh::SubdivisionScheme::kCatmullClark);

}  // namespace clerestory::support
