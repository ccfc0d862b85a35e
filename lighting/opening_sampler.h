// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/geometry.h"

namespace clerestory::lighting {

/// A direction towards a polygon with its inverse density.
struct SolidAngleSample {
  mesh::Vector direction;
  double solid_angle_sr = 0.0;  ///< one over the density; 0: nothing to see
};

/// Directions from a point towards a triangulated polygon, uniform in solid angle: one of its triangles in proportion to solid angle,
/// then by Arvo's map of the unit square on a spherical triangle [Arvo 1995]; triangles of tiny solid angle by area.
class OpeningSampler {
 public:
  OpeningSampler(const mesh::Point& from, std::span<const std::array<mesh::Point, 3>> triangles);

  [[nodiscard]] double solid_angle_sr() const { return total_; }
  /// The direction that belongs to (a, b) in the unit square.
  [[nodiscard]] SolidAngleSample sample(double a, double b) const;

 private:
  /// A triangle as it is seen.
  struct Part {
    std::array<mesh::Vector, 3> corners;  ///< unit vectors
    double up_to_sr = 0.0;                ///< the solid angle of all up to this one
  };
  [[nodiscard]] std::span<const Part> parts() const {
    return many_.empty() ? std::span(few_).first(triangles_.size()) : std::span(many_);
  }

  mesh::Point from_;
  std::span<const std::array<mesh::Point, 3>> triangles_;
  /// Few of them without a visit to the heap, since many samplers serve one ray.
  static constexpr std::size_t kFew = 4;
  std::array<Part, kFew> few_;
  std::vector<Part> many_;
  double total_ = 0.0;
};

}  // namespace clerestory::lighting
