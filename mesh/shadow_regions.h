// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/discontinuity_sources.h"
#include "mesh/faces.h"
#include "mesh/rays.h"

namespace clerestory::mesh {

/// What a place sees of the sources that it faces.
enum class Shade : std::uint8_t {
  kNone = 0,      ///< it faces none
  kLit = 1,       ///< all of them wholly
  kPenumbra = 2,  ///< some of them, or some wholly or in part
  kUmbra = 3,     ///< nothing of them
};

/// The shade of a point of a surface, by rays to points of the sources: the corners and edges of a polygon, where shadows begin, and
/// its middle.
Shade shade_at(const Rays& rays, std::span<const ShadowSource> sources, const Point& at, const Vector& normal);

/// The shade of the patches of a mesh, at the middle of the largest triangle of each: between lines of discontinuity it does not
/// change, but for what EEE surfaces bound.
/// @return [2 a triangle of the mesh] by side, front first
std::vector<Shade> shade_patches(const Faces& faces, const Triangulation& mesh, const Rays& rays,
                                 std::span<const ShadowSource> sources);

}  // namespace clerestory::mesh
