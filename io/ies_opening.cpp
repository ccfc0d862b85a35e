// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ies_opening.h"

#include <cmath>
#include <string>

namespace clerestory::io {

using lighting::LuminousOpening;
using Shape = LuminousOpening::Shape;

namespace {

char sign(double value) { return value > 0.0 ? '+' : value < 0.0 ? '-' : '0'; }

/// As the standard of 2002 has it; nothing where it has no such signs.
std::optional<Shape> shape_since_2002(const std::string& signs) {
  if (signs == "000") return Shape::kPoint;
  if (signs == "++0" || signs == "+++") return Shape::kRectangle;
  if (signs == "--0" || signs == "--+") return Shape::kEllipse;
  if (signs == "---") return Shape::kEllipsoid;
  if (signs == "-+-") return Shape::kCylinderAlongX;
  if (signs == "+--") return Shape::kCylinderAlongY;
  if (signs == "-0-") return Shape::kUprightDisc;
  return std::nullopt;
}

std::optional<Shape> shape_before(const std::string& signs) {
  if (signs == "-00" || signs == "-0+" || signs == "-+0" || signs == "-++" || signs == "+-0" || signs == "+-+")
    return Shape::kEllipse;
  if (signs == "-0-" || signs == "-+-" || signs == "+--") return Shape::kEllipsoid;
  if (signs == "0+-") return Shape::kCylinderAlongX;
  if (signs == "+0-") return Shape::kCylinderAlongY;
  if (signs == "0+0" || signs == "+00" || signs == "00+") return Shape::kRectangle;
  return std::nullopt;
}

}  // namespace

std::optional<LuminousOpening> ies_opening(double width_m, double length_m, double height_m, int year) {
  const std::string signs{sign(width_m), sign(length_m), sign(height_m)};
  const auto newer = shape_since_2002(signs);
  const auto older = shape_before(signs);
  const auto shape = year >= 2002 ? (newer ? newer : older) : (older ? older : newer);
  if (!shape) return std::nullopt;
  LuminousOpening opening{
      .shape = *shape, .x_m = std::abs(length_m), .y_m = std::abs(width_m), .z_m = std::abs(height_m)};
  // The older circles, spheres and cylinders state a diameter once.
  if (signs == "-00" || signs == "-0+" || (signs == "-0-" && *shape == Shape::kEllipsoid)) opening.x_m = opening.y_m;
  if (signs == "0+-") opening.y_m = opening.z_m;
  if (signs == "+0-") opening.x_m = opening.z_m;
  if (*shape == Shape::kRectangle || *shape == Shape::kEllipse) opening.sides_m.fill(opening.z_m);
  return opening;
}

}  // namespace clerestory::io
