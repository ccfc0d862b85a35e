// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/seen_factor.h"

#include <algorithm>

#include "lighting/form_factor.h"
#include "mesh/seen_parts.h"

namespace clerestory::lighting {

using mesh::Point;
using mesh::Vector;

namespace {

/// Where more stand before a polygon, rays are quicker than clipping.
constexpr std::size_t kMostBlockers = 48;

}  // namespace

SeenFactor seen_factor(const mesh::Shafts& shafts, const Point& at, const Vector& normal,
                       std::span<const std::array<Point, 3>> triangles, const Vector& triangles_normal) {
  std::array<mesh::OutlineEdge, mesh::ConvexPiece::kMostCorners> scratch;
  SeenFactor seen;
  for (const std::array<Point, 3>& triangle : triangles) {
    const mesh::ShaftEnd eye{.corners = {at}, .count = 1, .normal = {}};
    const mesh::ShaftEnd far{
        .corners = {triangle[0], triangle[1], triangle[2]}, .count = triangle.size(), .normal = triangles_normal};
    const mesh::Shafts::Blockers blockers = shafts.blockers(eye, far, kMostBlockers);
    auto parts = mesh::seen_parts(at, triangle, blockers.polygons);
    seen.exact = seen.exact && blockers.all && parts;
    // Too many pieces: nothing is known of what is hidden.
    if (!parts) parts = mesh::seen_parts(at, triangle, {});
    for (const mesh::ConvexPiece& part : *parts)
      seen.factor += std::max(0.0, point_form_factor(at, normal, part.outline(scratch), triangles_normal));
  }
  // What rounding leaves between blockers that share an edge is no sight.
  if (seen.factor <= kLeastFactor) return {};
  return seen;
}

}  // namespace clerestory::lighting
