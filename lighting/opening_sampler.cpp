// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/opening_sampler.h"

#include <algorithm>
#include <cmath>

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
  return 2.0 * std::atan2(above, below);
}

double clamped_acos(double x) { return std::acos(std::clamp(x, -1.0, 1.0)); }

/// The part of x that is orthogonal to a, normalised.
Vector orthogonal(const Vector& x, const Vector& a) { return normalized(x - dot(x, a) * a); }

/// Arvo's algorithm; A, B, C unit vectors.
Vector spherical_triangle_point(const Vector& a, const Vector& b, const Vector& c, double x, double y) {
  const Vector ab = normalized(cross(a, b));
  const Vector bc = normalized(cross(b, c));
  const Vector ca = normalized(cross(c, a));
  const double alpha = clamped_acos(-dot(ca, ab));
  const double beta = clamped_acos(-dot(ab, bc));
  const double gamma = clamped_acos(-dot(bc, ca));
  const double area = x * (alpha + beta + gamma - 3.14159265358979323846);
  const double s = std::sin(area - alpha);
  const double t = std::cos(area - alpha);
  const double cos_alpha = std::cos(alpha);
  const double sin_alpha = std::sin(alpha);
  const double cos_c = dot(a, b);
  const double u = t - cos_alpha;
  const double v = s + sin_alpha * cos_c;
  const double below = (v * s + u * t) * sin_alpha;
  const double q = below != 0.0 ? std::clamp(((v * t - u * s) * cos_alpha - v) / below, -1.0, 1.0) : 1.0;
  const Vector moved = q * a + std::sqrt(std::max(0.0, 1.0 - q * q)) * orthogonal(c, a);
  const double z = 1.0 - y * (1.0 - dot(moved, b));
  return normalized(z * b + std::sqrt(std::max(0.0, 1.0 - z * z)) * orthogonal(moved, b));
}

}  // namespace

OpeningSampler::OpeningSampler(const Point& from, std::span<const std::array<Point, 3>> triangles)
    : from_(from), triangles_(triangles) {
  cumulative_.reserve(triangles.size());
  for (const auto& t : triangles) {
    total_ += triangle_solid_angle(normalized(t[0] - from), normalized(t[1] - from), normalized(t[2] - from));
    cumulative_.push_back(total_);
  }
}

SolidAngleSample OpeningSampler::sample(double a, double b) const {
  if (total_ <= 0.0) return {};
  const double wanted = a * total_;
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), wanted);
  const auto i = static_cast<std::size_t>(std::min(found, cumulative_.end() - 1) - cumulative_.begin());
  const double before = i == 0 ? 0.0 : cumulative_[i - 1];
  const double own = cumulative_[i] - before;
  if (own <= 0.0) return {};
  const double x = std::clamp((wanted - before) / own, 0.0, 1.0);
  const auto& t = triangles_[i];
  if (own >= kTinySolidAngle) {
    const Vector d =
        spherical_triangle_point(normalized(t[0] - from_), normalized(t[1] - from_), normalized(t[2] - from_), x, b);
    return {d, total_};
  }
  const double r = std::sqrt(x);
  const Point p = t[0] + (r * (1.0 - b) * (t[1] - t[0]) + r * b * (t[2] - t[0]));
  const Vector d = p - from_;
  const Vector n = cross(t[1] - t[0], t[2] - t[0]);
  const double distance = norm(d);
  const double projected = 0.5 * std::abs(dot(n, d)) / (distance * distance * distance);
  return {d / distance, total_ / own * projected};
}

}  // namespace clerestory::lighting
