// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "io/radiance_scene.h"
#include "mesh/geometry.h"

namespace clerestory::io {

/// A polygon of a shape: one outer loop and at most one hole, corners by index.
struct ShapePolygon {
  std::vector<std::uint32_t> outer;
  std::vector<std::uint32_t> hole;
};

/// A surface as polygons, fronts as Radiance has them.
struct Shape {
  std::vector<mesh::Point> points;
  std::vector<ShapePolygon> polygons;
};

/// How far a chord may lie from its arc: this share of the radius, but never less than kFinestChord nor more than kCoarsestChord [file
/// units, which are metres as a rule].
inline constexpr double kChordOverRadius = 0.01;
inline constexpr double kFinestChord = 0.0005;
inline constexpr double kCoarsestChord = 0.005;

/// Straight pieces of a full circle: even, 8 … 128.
std::size_t circle_pieces(double radius);

/// The polygons of a polygon, ring, cylinder, tube, cone, cup, sphere or bubble. A polygon stays as it is: where its outline runs to a
/// hole and back by the same seam, clean() takes it apart. Round shapes become as many flat pieces as the chord allows after scaling;
/// their corners lie outside the true surface by so much that a circle keeps its length (a cylinder its area; a disk has at most
/// 0.6 % too little of it at 24 pieces) and a sphere its area. Circles of one axis and radius have the same corners, but for the smaller
/// end of a cone, which has those of the larger.
/// No polygon where the numbers make no surface: under 3 corners, radii of zero, ends that meet, a wrong count of numbers.
/// @param scale  by which lengths are multiplied later
/// Source: Ward and others, The RADIANCE 5.1 Synthetic Imaging System, section 2.1.1.
Shape radiance_shape(const RadiancePrimitive& primitive, double scale = 1.0);

}  // namespace clerestory::io
