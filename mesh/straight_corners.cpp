// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/straight_corners.h"

#include <cstddef>

namespace clerestory::mesh {

namespace {

/// Edges that turn by less are one edge [rad].
constexpr double kStraight = 1e-6;

}  // namespace

std::vector<Point> without_straight_corners(std::span<const Point> loop) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point& before = kept.empty() ? loop.back() : kept.back();
    const Vector here = normalized(loop[i] - before);
    const Vector next = normalized(loop[(i + 1) % loop.size()] - loop[i]);
    if (norm(cross(here, next)) > kStraight || dot(here, next) < 0.0) kept.push_back(loop[i]);
  }
  return kept;
}

}  // namespace clerestory::mesh
