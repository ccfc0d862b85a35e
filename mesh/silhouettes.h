// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/faces.h"
#include "mesh/geometry.h"
#include "mesh/ids.h"

// Private to mesh/.
namespace clerestory::mesh {

/// A straight edge of the opaque surfaces that can be a silhouette: somewhere around it there is an open half space.
struct OccluderEdge {
  std::array<std::uint32_t, 2> ends{};  ///< vertices of Occluders
  Vector direction;                     ///< unit, from the first end to the second
  std::uint32_t first_sheet = 0;
  std::uint32_t end_sheet = 0;
};

/// A surface that ends at, or passes through, an edge.
struct Sheet {
  Vector away;  ///< unit, in the surface, at right angles to the edge and away from it
  FaceId face;
};

/// The edges and corners by which opaque faces cast shadows. Edges in line from which surfaces go in the same directions are one.
class Occluders {
 public:
  /// @param passable  [faces] non-zero for faces that light passes: they cast no shadow; empty: all are opaque
  explicit Occluders(const Faces& faces, std::span<const std::uint8_t> passable = {});

  [[nodiscard]] std::span<const OccluderEdge> edges() const { return edges_; }
  [[nodiscard]] std::size_t vertex_count() const { return points_.size(); }
  [[nodiscard]] const Point& point(std::uint32_t vertex) const { return points_[vertex]; }
  [[nodiscard]] std::array<Point, 2> ends(const OccluderEdge& e) const {
    return {points_[e.ends[0]], points_[e.ends[1]]};
  }
  /// The surfaces at an edge, the largest face first.
  [[nodiscard]] std::span<const Sheet> sheets(const OccluderEdge& e) const {
    return std::span(sheets_).subspan(e.first_sheet, e.end_sheet - e.first_sheet);
  }
  /// Edges that end at a vertex.
  [[nodiscard]] std::span<const std::uint32_t> edges_at(std::uint32_t vertex) const {
    return std::span(edges_at_).subspan(edges_start_[vertex], edges_start_[vertex + 1] - edges_start_[vertex]);
  }
  /// The triangles of opaque faces at a vertex, by the directions of their two sides that start there [m].
  [[nodiscard]] std::span<const std::array<Vector, 2>> corners_at(std::uint32_t vertex) const {
    return std::span(corners_at_).subspan(corners_start_[vertex], corners_start_[vertex + 1] - corners_start_[vertex]);
  }

  /// Whether lines along a direction that pass an edge are free on one side of it and shut on the other: the unit normal, of the
  /// plane of line and edge, that points to the free side; nothing where the edge is no silhouette, or the line runs along it.
  [[nodiscard]] std::optional<Vector> free_side(const OccluderEdge& e, const Vector& line) const;

  /// Whether some of the lines of a direction that pass a vertex closely are free of the surfaces at it.
  [[nodiscard]] bool is_contour(std::uint32_t vertex, const Vector& line) const;

 private:
  std::vector<Point> points_;
  std::vector<OccluderEdge> edges_;
  std::vector<Sheet> sheets_;
  std::vector<std::uint32_t> edges_at_;
  std::vector<std::uint32_t> edges_start_;
  std::vector<std::array<Vector, 2>> corners_at_;
  std::vector<std::uint32_t> corners_start_;
};

}  // namespace clerestory::mesh
