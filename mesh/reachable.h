// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/faces.h"
#include "mesh/progress.h"
#include "mesh/rays.h"

namespace clerestory::mesh {

/// Which face sides light, or the outside, can reach: [2 a face, front first] 1 or 0. The insides of solids are not among them.
/// A side is reached when one of its regions exchanges at least two rays with what is reached already: with the outside (rays
/// that leave the model upwards or downwards), with a seed, or with another reached side. One ray alone is never believed: it may
/// have slipped through an edge. Glazing and openings let the rays pass. Deterministic; no promise for slits that fewer than about
/// one in 2,000 rays find.
/// @param seeds        [2 a face] non-zero for sides that shine; may be empty
/// @param seed_points  point sources [m, local coordinates]
/// @param progress     hears which share is done; may be null
std::vector<std::uint8_t> reachable_sides(const Faces& faces, const Rays& rays, std::span<const std::uint8_t> seeds,
                                          std::span<const Point> seed_points, Progress* progress = nullptr);

/// The same for triangles of the shape: [2 a triangle, front first]. Where a face is partly covered (a floor under a wall that has
/// no foot of its own), its side is reachable, its covered region is not.
/// @param sides     what reachable_sides() gave for these faces
/// @param progress  hears which share is done; may be null
std::vector<std::uint8_t> reachable_triangles(const Faces& faces, const Rays& rays, std::span<const std::uint8_t> sides,
                                              Progress* progress = nullptr);

}  // namespace clerestory::mesh
