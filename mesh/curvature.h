// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "mesh/geometry.h"
#include "mesh/limit_surface.h"

namespace clerestory::mesh {

/// What the triangles of a model stand for that tessellate limit surfaces. Immutable once the model is made.
struct Curvature {
  static constexpr std::uint32_t kFlat = std::numeric_limits<std::uint32_t>::max();

  struct Facet {
    std::uint32_t surface = 0;
    PatchTriangle on_surface;
    std::array<Point, 3> corners{};  ///< [m, model coordinates]
    double deviation_m = 0.0;        ///< of the limit surface from the triangle
  };

  std::vector<LimitSurface> surfaces;
  std::vector<Facet> facets;
  std::vector<std::uint32_t> facet_of;  ///< [polygons of the model] index into facets, kFlat for the others

  /// The point of the limit surface that a point of a facet's plane stands for; points outside of the facet are drawn to it. On an edge
  /// that facets share both give the same point.
  [[nodiscard]] LimitPoint limit(std::uint32_t facet, const Point& point) const;
  /// Of several facets in one plane the one that holds a point of it, or reaches nearest to it [not empty].
  [[nodiscard]] std::uint32_t nearest(std::span<const std::uint32_t> candidates, const Point& point) const;
};

}  // namespace clerestory::mesh
