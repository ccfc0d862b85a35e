// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "mesh/geometry.h"

// Private to mesh/.
namespace clerestory::mesh {

inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

/// The triangle across each edge, which has it the other way round; kNoTriangle where there is none. The edge k of a triangle begins at its
/// corner k.
/// @param triangles  of one plane, counter-clockwise from one side; no two have an edge in the same direction
std::vector<std::array<std::uint32_t, 3>> triangles_across(std::span<const std::array<std::uint32_t, 3>> triangles);

/// The outline of triangles of one plane: edges that go on in a line are one. What follows an outline, as Lambert's form factor does, then
/// costs what its corners ask for, however fine the triangles are.
/// @param vertices  that the edges name
/// @param edges     of the triangles, counter-clockwise from one side, but for those that are walked both ways
/// @return from and to, in the order of the edges that they begin with
std::vector<std::array<std::uint32_t, 2>> group_outline(std::span<const Point> vertices,
                                                        std::span<const std::array<std::uint32_t, 2>> edges);

}  // namespace clerestory::mesh
