// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/faces.h"
#include "mesh/geometry.h"
#include "mesh/ids.h"

namespace clerestory::mesh {

/// The regions of all faces, numbered through: what the boundary and the contact lines of a face leave connected. A region lies
/// wholly inside a solid or wholly outside of it, which a face need not.
struct Regions {
  std::vector<std::uint32_t> of_triangle;  ///< [triangles of the shape] region
  std::vector<FaceId> face;                ///< [regions]
  std::vector<double> area_m2;             ///< [regions]
  std::vector<double> width_m;  ///< [regions] 2 · area / perimeter: half the width of a square, the width of a strip
  std::vector<std::uint32_t> starts{0};  ///< region r has triangles[starts[r]] … triangles[starts[r+1]-1]
  std::vector<std::uint32_t> triangles;  ///< indices into the shape's triangles

  [[nodiscard]] std::size_t count() const { return face.size(); }
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t region) const {
    return std::span(triangles).subspan(starts[region], starts[region + 1] - starts[region]);
  }
};

/// @param labels  [triangles of the shape] what divides regions further, such as the rooms of a floor that goes on below an open
///                door; empty: nothing
Regions number_regions(const Faces& faces, std::span<const std::uint32_t> labels = {});

/// The corners of a triangle of the shape.
std::array<Point, 3> corners(const Faces& faces, std::uint32_t triangle);

/// The normal of one side of a face.
Vector side_normal(const Faces& faces, FaceId face, Side side);

/// Coordinate `dimension` (below 5) of point i of an additive low-discrepancy sequence in [0, 1), displaced by the seed.
/// Source: Roberts, The unreasonable effectiveness of quasirandom sequences, 2018 (generalised golden ratios).
double spread(std::uint32_t i, std::uint32_t dimension, std::uint64_t seed);

/// Points spread evenly over a region, the same ones on each call; a little inside of its triangles.
class RegionPoints {
 public:
  RegionPoints(const Faces& faces, const Regions& regions, std::size_t region);
  /// Point i of a low-discrepancy sequence.
  [[nodiscard]] Point at(std::uint32_t i) const;

 private:
  const Faces& faces_;
  std::span<const std::uint32_t> triangles_;
  std::vector<double> area_up_to_;
  std::uint64_t seed_;
};

/// A direction by the cosine law about w, from two numbers in [0, 1).
Vector cosine_direction(const Frame& frame, double a, double b);

/// A direction evenly over the sphere, from two numbers in [0, 1).
Vector sphere_direction(double a, double b);

}  // namespace clerestory::mesh
