// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminous_opening.h"

#include <cmath>
#include <numbers>

namespace clerestory::lighting {

using mesh::Vector;

namespace {

constexpr double kPi = std::numbers::pi;

/// Of an upright prism's sides, those that face a direction; without its top.
double sides_seen(const LuminousOpening& o, const Vector& d) {
  const double facing_x = d.x >= 0.0 ? o.sides_m[0] : o.sides_m[2];
  const double facing_y = d.y >= 0.0 ? o.sides_m[1] : o.sides_m[3];
  if (o.shape == LuminousOpening::Shape::kRectangle)
    return std::abs(d.x) * o.y_m * facing_x + std::abs(d.y) * o.x_m * facing_y;
  const double level2 = d.x * d.x + d.y * d.y;
  if (level2 <= 0.0) return 0.0;
  const double height = (d.x * d.x * facing_x + d.y * d.y * facing_y) / level2;
  return height * std::hypot(o.x_m * d.y, o.y_m * d.x);
}

double ellipsoid_seen(const LuminousOpening& o, const Vector& d) {
  return kPi / 4.0 *
         std::sqrt(std::pow(o.y_m * o.z_m * d.x, 2) + std::pow(o.x_m * o.z_m * d.y, 2) +
                   std::pow(o.x_m * o.y_m * d.z, 2));
}

/// @param along  of the direction, along the cylinder
double cylinder_seen(double length, double width, double height, double along, double across, double up) {
  return kPi / 4.0 * width * height * std::abs(along) + length * std::hypot(width * up, height * across);
}

}  // namespace

bool LuminousOpening::has_area() const {
  return (x_m > 0.0 && y_m > 0.0) || (x_m > 0.0 && z_m > 0.0) || (y_m > 0.0 && z_m > 0.0);
}

double LuminousOpening::projected_area_m2(const Vector& d) const {
  switch (shape) {
    case Shape::kPoint:
      return 0.0;
    case Shape::kRectangle:
      return x_m * y_m * std::abs(d.z) + sides_seen(*this, d);
    case Shape::kEllipse:
      return kPi / 4.0 * x_m * y_m * std::abs(d.z) + sides_seen(*this, d);
    case Shape::kEllipsoid:
      return ellipsoid_seen(*this, d);
    case Shape::kCylinderAlongX:
      return cylinder_seen(x_m, y_m, z_m, d.x, d.y, d.z);
    case Shape::kCylinderAlongY:
      return cylinder_seen(y_m, x_m, z_m, d.y, d.x, d.z);
    case Shape::kUprightDisc:
      return kPi / 4.0 * y_m * z_m * std::abs(d.x);
  }
  return 0.0;
}

Vector LuminousOpening::place(double u, double v, double t) const {
  const double z = (t - 0.5) * z_m;
  const bool round = shape == Shape::kEllipse || shape == Shape::kEllipsoid;
  if (!round) return {(u - 0.5) * x_m, (v - 0.5) * y_m, z};
  const double radius = 0.5 * std::sqrt(u);
  const double angle = 2.0 * kPi * v;
  return {radius * std::cos(angle) * x_m, radius * std::sin(angle) * y_m, z};
}

}  // namespace clerestory::lighting
