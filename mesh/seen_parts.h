// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "mesh/element_tree.h"
#include "mesh/geometry.h"

namespace clerestory::mesh {

/// A convex planar polygon.
struct ConvexPiece {
  static constexpr std::size_t kMostCorners = 12;

  std::array<Point, kMostCorners> corners{};
  std::size_t count = 0;

  /// Its edges in turn.
  std::span<const OutlineEdge> outline(std::array<OutlineEdge, kMostCorners>& scratch) const;
};

/// The parts of a convex planar polygon that a point sees past blockers, exact but for rounding: hidden surfaces are removed by clipping polygons
/// [Weiler, Atherton 1977], in the space of directions from the point, so that blockers may reach the point's own plane.
/// @param polygon   at most four corners in turn; the parts are wound as it is
/// @param blockers  convex planar polygons; those whose plane holds the point hide nothing
/// @return convex pieces that do not overlap; nothing where they would be more than 128, or have more corners than a piece can have, or take
/// long to find in a crowd
std::optional<std::vector<ConvexPiece>> seen_parts(const Point& from, std::span<const Point> polygon,
                                                   std::span<const std::span<const Point>> blockers);

}  // namespace clerestory::mesh
