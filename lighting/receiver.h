// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "mesh/element_tree.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// What receives light at a point: a plane, by the cosine to its normal, or the mantle of a small upright cylinder, whose illuminance is the
/// mean over azimuth of that of the planes along its axis: light from a direction counts by sin θ / π, θ from the axis.
/// Source: EN 12665:2018, cylindrical illuminance.
class Receiver {
 public:
  /// A plane; a normal alone stands for one wherever a receiver is asked for.
  Receiver(const mesh::Vector& normal) : axis_(normal) {}  // NOLINT(google-explicit-constructor)
  static Receiver cylinder(const mesh::Vector& axis) { return {axis, true}; }

  [[nodiscard]] bool is_cylinder() const { return cylinder_; }
  /// The plane's normal or the cylinder's axis, of unit length.
  [[nodiscard]] const mesh::Vector& axis() const { return axis_; }

  /// By how much light from a direction counts, times that vector's length; zero or less where it does not.
  [[nodiscard]] double kernel(const mesh::Vector& from) const { return cylinder_ ? around(from) : dot(from, axis_); }

  /// The direction of a point of the unit square, its density that of the kernel: the mean luminance of such directions, times π, is
  /// the illuminance.
  [[nodiscard]] mesh::Vector direction(const mesh::Frame& frame, double a, double b) const;

  /// The share of what a planar polygon gives that would fill all directions, unoccluded: of a plane its form factor
  /// (point_form_factor(), with the same arguments); of a cylinder the mean of those of 45 planes about it, within 0.03 % of the exact mean.
  [[nodiscard]] double form_factor(const mesh::Point& at, std::span<const mesh::OutlineEdge> outline,
                                   const mesh::Vector& outline_normal) const;

 private:
  Receiver(const mesh::Vector& axis, bool cylinder) : axis_(axis), cylinder_(cylinder) {}
  [[nodiscard]] double around(const mesh::Vector& from) const;

  mesh::Vector axis_;
  bool cylinder_ = false;
};

/// Sensors by their places and axes: planes all, or cylinders all. Local coordinates [m].
struct SensorSet {
  std::span<const mesh::Point> positions;
  std::span<const mesh::Vector> axes;
  bool cylinders = false;

  [[nodiscard]] std::size_t count() const { return positions.size(); }
  [[nodiscard]] Receiver receiver(std::size_t i) const {
    return cylinders ? Receiver::cylinder(axes[i]) : Receiver(axes[i]);
  }
};

}  // namespace clerestory::lighting
