// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/model.h"

// Private to mesh/.
namespace clerestory::mesh {

/// A polygon while it is being repaired. The first loop is the outer one.
struct SoupPolygon {
  std::vector<std::vector<std::uint32_t>> loops;
  MaterialId material;
  PartId part;
  std::uint32_t source = 0;  ///< polygon of the model that it comes from
  bool flipped = false;      ///< wound the other way round than the source
  bool checked = false;      ///< for what it overlaps and crosses
  bool covered = false;      ///< a piece that lies on another, which stays in its place
  bool covering = false;     ///< stays where others lie on it
  /// Of a closed solid: 1 where the front looks out of it, -1 where it looks in; else 0. Pieces keep it.
  std::int8_t outward = 0;
  std::uint32_t line = 0;
  MaterialId back_material = {};  ///< on the back of the source, where another polygon gave it one; else not valid
};

/// A model while it is being repaired.
struct Soup {
  std::vector<Point> points;
  std::vector<SoupPolygon> polygons;
};

/// The model's polygons, holes the other way round than their outer loops.
Soup to_soup(const Model& model);

/// The soup as a model, points that no polygon uses left out; names are those of the given model.
Model to_model(const Soup& soup, const Model& names);

/// Winds a polygon the other way round.
void flip(SoupPolygon& polygon);

/// Sum of cross products along a closed loop: twice its area times its normal [m²]. Newell's method.
Vector newell(std::span<const Point> points, std::span<const std::uint32_t> loop);

/// Area of the outer loop less that of the holes [m²]. A loop that crosses itself counts its parts against each other.
double area(std::span<const Point> points, const SoupPolygon& polygon);

struct Plane {
  Point origin;
  Vector normal;  ///< unit length

  [[nodiscard]] double distance(const Point& p) const { return dot(p - origin, normal); }
};

/// The mean plane of the outer loop; nothing where all corners lie on one line within the tolerance [m].
/// For a loop whose parts cancel (a bow-tie) the normal is that of the largest triangle of three successive corners.
std::optional<Plane> plane_of(std::span<const Point> points, const SoupPolygon& polygon, double tolerance);

/// Calls visit(a, b) for every directed edge of the polygon.
template <class Visit>
void for_each_edge(const SoupPolygon& polygon, const Visit& visit) {
  for (const std::vector<std::uint32_t>& loop : polygon.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[(i + 1) % loop.size()]);
  }
}

}  // namespace clerestory::mesh
