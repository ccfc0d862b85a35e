// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/box_tree.h"
#include "mesh/geometry.h"

// Private to mesh/.
namespace clerestory::mesh {

/// A place in a plane, in the coordinates of its frame [m].
struct Point2 {
  double x = 0.0;
  double y = 0.0;
};

/// Coordinates in a plane, and back.
struct PlaneCoordinates {
  Point origin;
  Frame frame;

  [[nodiscard]] Point2 project(const Point& p) const { return {dot(p - origin, frame.u), dot(p - origin, frame.v)}; }
  [[nodiscard]] Point lift(const Point2& p) const { return origin + p.x * frame.u + p.y * frame.v; }
  [[nodiscard]] double distance(const Point& p) const { return dot(p - origin, frame.w); }
};

/// Whether a box comes within a distance of a plane; a negative one asks for boxes that reach as far beyond it on both sides [m].
bool near_plane(const Box& box, const PlaneCoordinates& plane, double distance);

/// Twice the signed area of a triangle, positive when counter-clockwise [m²].
constexpr double doubled_area(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A stretch of a segment, by parameters from its first end (0) to its second (1).
struct Stretch {
  double begin = 0.0;
  double end = 0.0;
};

/// The part of a plane that closed, directed boundaries wind round (nonzero rule): so overlaps are inside once, holes
/// go the other way round, and bridges walked both ways are nothing.
class PlanarOutline {
 public:
  using Segment = std::array<Point2, 2>;

  explicit PlanarOutline(std::vector<Segment> segments);

  /// How often the boundary winds round a point; unsure within rounding of the boundary.
  [[nodiscard]] int winding(const Point2& p) const;
  /// Whether the boundary passes within a distance of a point.
  [[nodiscard]] bool near_boundary(const Point2& p, double distance) const;
  /// The stretches of the segment from a to b that lie inside, longer than the tolerance and not along the boundary.
  [[nodiscard]] std::vector<Stretch> inner_stretches(const Point2& a, const Point2& b, double tolerance) const;

 private:
  [[nodiscard]] std::vector<double> crossings(const Point2& a, const Point2& b, double tolerance) const;

  std::vector<Segment> segments_;
  BoxTree tree_;
};

}  // namespace clerestory::mesh
