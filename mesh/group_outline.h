// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/geometry.h"

// Private to mesh/.
namespace clerestory::mesh {

/// The outline of triangles of one plane: their edges but for those that are walked both ways, edges that go on in a line as one. What follows an
/// outline, as Lambert's form factor does, then costs what its corners ask for, however fine the triangles are.
/// @param vertices   that the triangles name
/// @param triangles  counter-clockwise, from one side
/// @return from and to, in the order of the triangles that the edges begin with
std::vector<std::array<std::uint32_t, 2>> group_outline(std::span<const Point> vertices,
                                                        std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace clerestory::mesh
