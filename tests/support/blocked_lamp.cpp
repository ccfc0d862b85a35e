// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/blocked_lamp.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>

namespace clerestory::support {

using mesh::Point;
using mesh::Vector;

namespace {

/// Shares of the lamp narrower than rounding [m].
constexpr double kFlat = 1e-13;

using Polygon = std::vector<Point>;

/// A plane's kept side: where dot(p - origin, normal) >= 0.
struct HalfSpace {
  Point origin;
  Vector normal;
};

/// The part of a convex polygon in a half space [Sutherland, Hodgman 1974].
Polygon clipped(std::span<const Point> polygon, const HalfSpace& half) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& p = polygon[i];
    const Point& q = polygon[(i + 1) % polygon.size()];
    const double hp = dot(p - half.origin, half.normal);
    const double hq = dot(q - half.origin, half.normal);
    if (hp >= 0.0) kept.push_back(p);
    if ((hp > 0.0 && hq < 0.0) || (hp < 0.0 && hq > 0.0)) kept.push_back(p + hp / (hp - hq) * (q - p));
  }
  return kept;
}

Vector normal_of(std::span<const Point> polygon) {
  Vector sum;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum = sum + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return normalized(sum);
}

/// What a blocker hides from a point: behind its plane, and between the planes through the point and its edges.
std::vector<HalfSpace> shadow_of(std::span<const Point> blocker, const Point& at) {
  Vector away = normal_of(blocker);
  const double height = dot(blocker[0] - at, away);
  if (std::abs(height) < kFlat) return {};
  if (height < 0.0) away = -away;
  const Point middle = blocker[0] + 0.5 * (midpoint(blocker[1], blocker[2]) - blocker[0]);
  std::vector<HalfSpace> sides{{blocker[0], away}};
  for (std::size_t i = 0; i < blocker.size(); ++i) {
    Vector inwards = normalized(cross(blocker[i] - at, blocker[(i + 1) % blocker.size()] - at));
    if (dot(middle - at, inwards) < 0.0) inwards = -inwards;
    sides.push_back({at, inwards});
  }
  return sides;
}

/// The parts of convex polygons outside of a convex region; those beside it stay whole.
std::vector<Polygon> outside(const std::vector<Polygon>& polygons, std::span<const HalfSpace> region) {
  if (region.empty()) return polygons;
  std::vector<Polygon> result;
  for (const Polygon& polygon : polygons) {
    const std::size_t before = result.size();
    Polygon rest = polygon;
    for (const HalfSpace& half : region) {
      Polygon out = clipped(rest, {half.origin, -half.normal});
      if (out.size() > 2) result.push_back(std::move(out));
      rest = clipped(rest, half);
      if (rest.size() < 3) break;
    }
    if (rest.size() > 2) continue;
    result.resize(before);
    result.push_back(polygon);
  }
  return result;
}

/// The cosine-weighted share of the hemisphere that a polygon covers [Lambert 1760].
double form_factor(const Polygon& polygon, const Point& at, const Vector& normal) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector a = polygon[i] - at;
    const Vector b = polygon[(i + 1) % polygon.size()] - at;
    const Vector across = cross(a, b);
    const double sine = norm(across);
    if (sine > 0.0) sum += std::atan2(sine, dot(a, b)) * dot(across, normal) / sine;
  }
  return std::abs(sum) / (2.0 * std::numbers::pi);
}

}  // namespace

double exact_illuminance(const BlockedLamp& scene, const Point& at, const Vector& normal) {
  std::vector<Polygon> seen{clipped(scene.lamp, {at, normal})};
  for (const Polygon& blocker : scene.blockers) seen = outside(seen, shadow_of(blocker, at));
  double factor = 0.0;
  for (const Polygon& polygon : seen) factor += form_factor(polygon, at, normal);
  return scene.exitance_lm_m2 * factor;
}

}  // namespace clerestory::support
