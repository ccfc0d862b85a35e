// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/receiver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lighting/form_factor.h"
#include "lighting/sampling.h"

namespace clerestory::lighting {

using mesh::Vector;

namespace {

/// Planes about a cylinder. Of an odd number n the mean of max(0, cos) over them has no harmonic before 2n, of relative size 2/(4n² − 1).
constexpr int kPlanes = 45;

/// The angle from the axis below which lies the share u of all that a cylinder receives of even light: the inverse of
/// (θ − sin θ cos θ)/π, by Newton's method in 2θ.
double polar_angle(double u) {
  const double lower = std::min(u, 1.0 - u);
  const double m = 2.0 * std::numbers::pi * lower;
  double x = std::cbrt(6.0 * m);  // below the root, and near it where m is small
  for (int step = 0; step < 6 && x > 0.0; ++step) x -= (x - std::sin(x) - m) / (1.0 - std::cos(x));
  const double theta = 0.5 * x;
  return u <= 0.5 ? theta : std::numbers::pi - theta;
}

}  // namespace

double Receiver::around(const Vector& from) const {
  const double along = dot(from, axis_);
  return std::sqrt(std::max(0.0, dot(from, from) - along * along)) / std::numbers::pi;
}

Vector Receiver::direction(const mesh::Frame& frame, double a, double b) const {
  if (!cylinder_) return cosine_direction(frame, a, b);
  const double theta = polar_angle(a);
  const double phi = 2.0 * std::numbers::pi * b;
  return std::sin(theta) * (std::cos(phi) * frame.u + std::sin(phi) * frame.v) + std::cos(theta) * frame.w;
}

double Receiver::form_factor(const mesh::Point& at, std::span<const mesh::OutlineEdge> outline,
                             const Vector& outline_normal) const {
  if (!cylinder_) return point_form_factor(at, axis_, outline, outline_normal);
  const mesh::Frame frame = mesh::frame_around(axis_);
  double sum = 0.0;
  for (int k = 0; k < kPlanes; ++k) {
    const double phi = 2.0 * std::numbers::pi * k / kPlanes;
    const Vector normal = std::cos(phi) * frame.u + std::sin(phi) * frame.v;
    sum += std::max(0.0, point_form_factor(at, normal, outline, outline_normal));
  }
  return sum / kPlanes;
}

}  // namespace clerestory::lighting
