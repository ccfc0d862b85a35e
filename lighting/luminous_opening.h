// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "mesh/geometry.h"

namespace clerestory::lighting {

/// The luminous part of a luminaire, in the luminaire's own axes: x along C0, y along C90, z against the axis of γ = 0. Its centre is the
/// origin.
struct LuminousOpening {
  enum class Shape {
    kPoint,
    kRectangle,       ///< a box where it has a height
    kEllipse,         ///< a circle or ellipse, a vertical cylinder where it has a height
    kEllipsoid,       ///< a sphere among them
    kCylinderAlongX,  ///< lying, its axis along C0
    kCylinderAlongY,  ///< lying, its axis along C90
    kUprightDisc,     ///< a disc that faces C0
  };

  Shape shape = Shape::kPoint;
  double x_m = 0.0;  ///< extent along C0–C180
  double y_m = 0.0;  ///< extent along C90–C270
  double z_m = 0.0;  ///< height
  /// Heights of the luminous sides that face C0, C90, C180 and C270 [m], of rectangles and ellipses.
  std::array<double, 4> sides_m{};

  /// The longest way across [m].
  [[nodiscard]] double size_m() const { return mesh::norm({x_m, y_m, z_m}); }

  /// Whether there is an area from which a luminance follows.
  [[nodiscard]] bool has_area() const;

  /// The area that is seen from afar in a direction of unit length [m²].
  /// Source: for rectangles and discs with luminous sides CIE 117:1995, 4.3; for the other bodies the shadow of an ellipsoid and of a cylinder.
  [[nodiscard]] double projected_area_m2(const mesh::Vector& direction) const;

  /// A place within the opening, of three numbers in [0, 1): uniform over a rectangle, box, ellipse or cylinder. Bodies that stand or lie are
  /// taken as upright prisms on their plan.
  [[nodiscard]] mesh::Vector place(double u, double v, double t) const;
};

}  // namespace clerestory::lighting
