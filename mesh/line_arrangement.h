// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/planar.h"
#include "mesh/triangulate.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Lines of discontinuity of one face among its boundary and contacts, so that a triangulation with them has neither slivers nor
/// crossings: lines come one by one, the weightiest first. Of a line that runs along what is there already, within a distance, that
/// part is left out; ends go to the nearest vertex or segment within the distance; crossings become vertices, and vertices
/// within the distance become part of the line. So no line is displaced by more than the distance, and what was there first not at all.
class LineArrangement {
 public:
  struct Segment {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    bool boundary = false;  ///< directed then: the face lies on the left
    bool line = false;      ///< added
  };

  /// @param points    of the face; stay as they are, and keep their numbers
  /// @param distance  within which things are one [m]
  LineArrangement(std::vector<Point2> points, std::vector<Segment> segments, double distance);

  /// Adds a line inside of the face. O(number of segments).
  /// @return the length of it that is new [m]
  double add(const Point2& a, const Point2& b);

  [[nodiscard]] const std::vector<Point2>& points() const { return points_; }
  [[nodiscard]] const std::vector<Segment>& segments() const { return segments_; }

 private:
  [[nodiscard]] std::vector<Stretch> new_parts(const Point2& a, const Point2& b) const;
  double insert(const Point2& a, const Point2& b);
  std::uint32_t snap(const Point2& p);
  std::uint32_t split(std::size_t segment, const Point2& at);
  std::vector<std::uint32_t> chain(std::uint32_t from, std::uint32_t to);
  [[nodiscard]] bool has_segment(std::uint32_t a, std::uint32_t b) const;

  std::vector<Point2> points_;
  std::vector<Segment> segments_;
  double distance_;
};

}  // namespace clerestory::mesh
