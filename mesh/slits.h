// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/faces.h"

namespace clerestory::mesh {

/// The feet of slits: where the edge of one face passes close before another one and the first rises from there, as a wall that stops
/// short of the floor or a door above its sill, the edge's projection on the other face, as far as it lies inside. Light and dark lie
/// side by side there as they do at a contact, and an element on both sides of the line would carry light through the wall.
/// Slits are up to 10 cm wide, and ten times as long; what stands over them is ten times as high.
/// @param has_side  [2 a face] non-zero for sides that carry elements; lines before others are left out
std::vector<FaceLine> slit_lines(const Faces& faces, std::span<const std::uint8_t> has_side);

}  // namespace clerestory::mesh
