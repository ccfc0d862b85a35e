// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/faces.h"

namespace clerestory::mesh {

/// Where the edge of one face passes close before another one and the first rises from there, as a wall that stops short of the floor or a door
/// above its sill: the edge's projection on the other face, as far as it lies inside. Light and dark lie side by side there as they do at a
/// contact, and an element on both sides of the line would carry light through the wall.
struct Slit {
  FaceLine foot;
  Side side = Side::kFront;  ///< of the foot's face, before which the edge passes
  double width_m = 0.0;      ///< between the edge and the face, where it is widest
};

/// All slits up to 10 cm wide and ten times as long, where what stands over them is ten times as high.
/// @param has_side  [2 a face] non-zero for sides that carry elements; slits before others are left out
std::vector<Slit> find_slits(const Faces& faces, std::span<const std::uint8_t> has_side);

/// The feet of slits, as lines for a mesh.
std::vector<FaceLine> feet_of(std::span<const Slit> slits);

}  // namespace clerestory::mesh
