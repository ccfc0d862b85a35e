// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/uncovering.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clerestory::mesh {

namespace {

/// Of a direction to the plane: edges at a corner are at least so steep, or would be of order 1.
constexpr double kLeastSlope = 1e-4;

/// The angle in the plane of a surface that two edges in it share, seen from a point [rad].
double common_angle(const std::array<Point, 2>& a, const std::array<Point, 2>& b, const Point& from,
                    const Vector& ahead, const Vector& aside) {
  const auto range = [&](const std::array<Point, 2>& edge) {
    const auto angle = [&](const Point& p) { return std::atan2(dot(p - from, aside), dot(p - from, ahead)); };
    return std::minmax({angle(edge[0]), angle(edge[1])});
  };
  const std::pair<double, double> of_a = range(a);
  const std::pair<double, double> of_b = range(b);
  return std::max(0.0, std::min(of_a.second, of_b.second) - std::max(of_a.first, of_b.first));
}

}  // namespace

double uncovering(const Wedge& wedge, const Sight& sight, const Vector& normal) {
  if (wedge.order == 0) return 0.0;
  const double distance = norm(sight.occluder - sight.receiver);
  if (distance <= 0.0) return 0.0;
  const Vector ahead = (sight.occluder - sight.receiver) / distance;
  const Vector aside = cross(ahead, wedge.free_side);
  // How fast source and occluder part, seen from a receiver that moves [rad/m].
  const double beyond = std::isinf(sight.source_m) ? 1.0 : sight.source_m / (distance + sight.source_m);
  const double rate = norm(cross(wedge.free_side, normal)) * beyond / distance;
  const double cosine = std::abs(dot(ahead, normal));
  if (wedge.order == 1) return cosine * rate * common_angle(wedge.edge, wedge.along, sight.receiver, ahead, aside);
  const auto slope = [&](const Vector& edge) {
    const double across = dot(edge, wedge.free_side);
    return dot(edge, aside) / std::copysign(std::max(std::abs(across), kLeastSlope), across);
  };
  return cosine * rate * rate * std::abs(slope(wedge.corner[1]) - slope(wedge.corner[0]));
}

}  // namespace clerestory::mesh
