// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/curvature.h"

#include <algorithm>

namespace clerestory::mesh {

namespace {

/// Barycentric coordinates of a point in the plane of a triangle.
std::array<double, 3> weights_of(const std::array<Point, 3>& c, const Point& point) {
  const Vector normal = cross(c[1] - c[0], c[2] - c[0]);
  const double square = dot(normal, normal);
  std::array<double, 3> weights{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point& a = c[(k + 1) % 3];
    weights[k] = dot(cross(c[(k + 2) % 3] - a, point - a), normal) / square;
  }
  return weights;
}

}  // namespace

LimitPoint Curvature::limit(std::uint32_t facet, const Point& point) const {
  const Facet& own = facets[facet];
  std::array<double, 3> weights = weights_of(own.corners, point);
  double sum = 0.0;
  for (double& w : weights) sum += w = std::max(0.0, w);
  double u = 0.0;
  double v = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    u += weights[k] / sum * own.on_surface.at[k][0];
    v += weights[k] / sum * own.on_surface.at[k][1];
  }
  return surfaces[own.surface].at(own.on_surface.patch, u, v);
}

std::uint32_t Curvature::nearest(std::span<const std::uint32_t> candidates, const Point& point) const {
  std::uint32_t best = candidates.front();
  double most = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t candidate : candidates) {
    const std::array<double, 3> weights = weights_of(facets[candidate].corners, point);
    const double least = *std::min_element(weights.begin(), weights.end());
    if (least <= most) continue;
    most = least;
    best = candidate;
  }
  return best;
}

}  // namespace clerestory::mesh
