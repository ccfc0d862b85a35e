// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/opening_sampler.h"

#include <algorithm>
#include <cmath>

#include "lighting/arc_tangent.h"

namespace clerestory::lighting {

using mesh::Point;
using mesh::Vector;

namespace {

/// Below this solid angle a triangle is sampled by area: the spherical map loses its digits [sr].
constexpr double kTinySolidAngle = 1e-5;

/// Source: Van Oosterom, Strackee, The Solid Angle of a Plane Triangle, 1983.
double triangle_solid_angle(const Vector& a, const Vector& b, const Vector& c) {
  const double above = std::abs(dot(a, cross(b, c)));
  const double below = 1.0 + dot(a, b) + dot(b, c) + dot(c, a);
  return 2.0 * arc_tangent(above, below);
}

/// The part of x that is orthogonal to a, normalised.
Vector orthogonal(const Vector& x, const Vector& a) { return normalized(x - dot(x, a) * a); }

/// Arvo's algorithm; A, B, C unit vectors that span a solid angle.
Vector spherical_triangle_point(const Vector& a, const Vector& b, const Vector& c, double solid_angle, double x,
                                double y) {
  const Vector ca = cross(c, a);
  const Vector ab = cross(a, b);
  const double cos_alpha = std::clamp(-dot(ca, ab) / std::sqrt(dot(ca, ca) * dot(ab, ab)), -1.0, 1.0);
  const double sin_alpha = std::sqrt(1.0 - cos_alpha * cos_alpha);
  const double area = x * solid_angle;
  const double sin_area = std::sin(area);
  const double cos_area = std::cos(area);
  const double s = sin_area * cos_alpha - cos_area * sin_alpha;  // of the angle area - alpha
  const double t = cos_area * cos_alpha + sin_area * sin_alpha;
  const double cos_c = dot(a, b);
  const double u = t - cos_alpha;
  const double v = s + sin_alpha * cos_c;
  const double below = (v * s + u * t) * sin_alpha;
  const double q = below != 0.0 ? std::clamp(((v * t - u * s) * cos_alpha - v) / below, -1.0, 1.0) : 1.0;
  const Vector moved = q * a + std::sqrt(std::max(0.0, 1.0 - q * q)) * orthogonal(c, a);
  const double z = 1.0 - y * (1.0 - dot(moved, b));
  return z * b + std::sqrt(std::max(0.0, 1.0 - z * z)) * orthogonal(moved, b);
}

}  // namespace

OpeningSampler::OpeningSampler(const Point& from, std::span<const std::array<Point, 3>> triangles)
    : from_(from), triangles_(triangles), many_(triangles.size() > kFew ? triangles.size() : 0) {
  const std::span<Part> parts = many_.empty() ? std::span<Part>(few_) : std::span<Part>(many_);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    auto& corners = parts[i].corners;
    for (std::size_t k = 0; k < 3; ++k) {
      // Triangles of one polygon share corners, and each takes a root.
      const Point& corner = triangles[i][k];
      std::size_t known = 0;
      while (known < 3 && (i == 0 || !(triangles[i - 1][known] == corner))) ++known;
      corners[k] = known < 3 ? parts[i - 1].corners[known] : normalized(corner - from);
    }
    total_ += triangle_solid_angle(corners[0], corners[1], corners[2]);
    parts[i].up_to_sr = total_;
  }
}

SolidAngleSample OpeningSampler::sample(double a, double b) const {
  if (total_ <= 0.0) return {};
  const std::span<const Part> parts = this->parts();
  const double wanted = a * total_;
  const auto found = std::ranges::upper_bound(parts, wanted, {}, &Part::up_to_sr);
  const auto i = static_cast<std::size_t>(std::min(found, parts.end() - 1) - parts.begin());
  const double before = i == 0 ? 0.0 : parts[i - 1].up_to_sr;
  const double own = parts[i].up_to_sr - before;
  if (own <= 0.0) return {};
  const double x = std::clamp((wanted - before) / own, 0.0, 1.0);
  if (own >= kTinySolidAngle) {
    const auto& corners = parts[i].corners;
    return {spherical_triangle_point(corners[0], corners[1], corners[2], own, x, b), total_};
  }
  const auto& t = triangles_[i];
  const double r = std::sqrt(x);
  const Point p = t[0] + (r * (1.0 - b) * (t[1] - t[0]) + r * b * (t[2] - t[0]));
  const Vector d = p - from_;
  const Vector n = cross(t[1] - t[0], t[2] - t[0]);
  const double distance = norm(d);
  const double projected = 0.5 * std::abs(dot(n, d)) / (distance * distance * distance);
  return {d / distance, total_ / own * projected};
}

}  // namespace clerestory::lighting
