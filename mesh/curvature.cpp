// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/curvature.h"

#include <algorithm>

namespace clerestory::mesh {

LimitPoint Curvature::limit(std::uint32_t facet, const Point& point) const {
  const Facet& own = facets[facet];
  const auto& c = own.corners;
  const Vector normal = cross(c[1] - c[0], c[2] - c[0]);
  const double square = dot(normal, normal);
  std::array<double, 3> weight{};
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point& a = c[(k + 1) % 3];
    weight[k] = std::max(0.0, dot(cross(c[(k + 2) % 3] - a, point - a), normal) / square);
    sum += weight[k];
  }
  const auto& at = own.on_surface.at;
  double u = 0.0;
  double v = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    u += weight[k] / sum * at[k][0];
    v += weight[k] / sum * at[k][1];
  }
  return surfaces[own.surface].at(own.on_surface.patch, u, v);
}

}  // namespace clerestory::mesh
