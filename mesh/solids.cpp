// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/solids.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "mesh/disjoint_sets.h"
#include "mesh/planar.h"
#include "mesh/soup.h"
#include "mesh/triangulate.h"

namespace clerestory::mesh {

namespace {

/// Faces and triangles with less are lines [m²].
constexpr double kNoArea = 1e-12;
/// Slivers of a face narrower than this are rounding [m].
constexpr double kNoWidth = 1e-9;

using Loop = std::vector<Point>;
using FlatLoop = std::vector<Point2>;

Vector newell_of(const Loop& loop) {
  std::vector<std::uint32_t> order(loop.size());
  std::iota(order.begin(), order.end(), 0U);
  return newell(loop, order);
}

double doubled_area(const FlatLoop& loop) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum += doubled_area(loop[0], loop[i], loop[i + 1]);
  return sum;
}

PlanarOutline outline_of(const FlatLoop& loop) {
  std::vector<PlanarOutline::Segment> segments;
  for (std::size_t i = 0; i < loop.size(); ++i) segments.push_back({loop[i], loop[(i + 1) % loop.size()]});
  return PlanarOutline(std::move(segments));
}

bool lies_inside(const FlatLoop& loop, const PlanarOutline& outline) {
  for (const Point2& p : loop)
    if (!outline.near_boundary(p, kSolidGrid)) return outline.winding(p) != 0;
  return false;
}

/// Loops at even depth counter-clockwise, those at odd depth the other way.
void nest(std::vector<FlatLoop>& loops) {
  std::vector<PlanarOutline> outlines;
  outlines.reserve(loops.size());
  for (const FlatLoop& loop : loops) outlines.push_back(outline_of(loop));
  for (std::size_t i = 0; i < loops.size(); ++i) {
    bool outer = true;
    for (std::size_t k = 0; k < loops.size(); ++k)
      if (k != i && lies_inside(loops[i], outlines[k])) outer = !outer;
    if ((doubled_area(loops[i]) > 0.0) != outer) std::reverse(loops[i].begin(), loops[i].end());
  }
}

/// The plane of the largest loop; nothing for loops without area.
std::optional<PlaneCoordinates> plane_of_loops(std::span<const Loop> loops) {
  Vector largest;
  Point origin;
  for (const Loop& loop : loops) {
    if (loop.size() < 3) continue;
    const Vector normal = newell_of(loop);
    if (norm(normal) <= norm(largest)) continue;
    largest = normal;
    origin = loop[0];
  }
  if (norm(largest) < kNoArea) return std::nullopt;
  return PlaneCoordinates{origin, frame_around(normalized(largest))};
}

/// A face as triangles of its corners; corners of crossings that the file did not mean are added at the end.
struct FilledFace {
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> rim;  ///< directed, the inside on the left
};

FilledFace fill(std::span<const Loop> loops, const PlaneCoordinates& plane) {
  std::vector<FlatLoop> flat;
  std::vector<std::pair<Point2, Point>> lifted;  // corners stay where they are, though the face may be bent
  for (const Loop& loop : loops) {
    if (loop.size() < 3) continue;
    flat.emplace_back();
    for (const Point& p : loop) {
      flat.back().push_back(plane.project(p));
      lifted.emplace_back(flat.back().back(), p);
    }
  }
  const auto before = [](const Point2& a, const Point2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::map<Point2, Point, decltype(before)> places(before);
  for (const auto& [p, place] : lifted) places.emplace(p, place);
  nest(flat);

  PlanarGraph graph;
  FilledFace face;
  for (const FlatLoop& loop : flat) {
    const auto first = static_cast<std::uint32_t>(graph.points.size());
    const auto count = static_cast<std::uint32_t>(loop.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      graph.points.push_back(loop[i]);
      face.rim.push_back({first + i, first + (i + 1) % count});
    }
  }
  graph.segments = face.rim;
  const PlanarMesh filled = triangulate_inside(graph, face.rim, kNoWidth);
  for (const Point2& p : filled.points) {
    const auto place = places.find(p);
    face.points.push_back(place != places.end() ? place->second : plane.lift(p));
  }
  for (const PlanarTriangle& triangle : filled.triangles) face.triangles.push_back(triangle.vertices);
  return face;
}

std::array<std::uint32_t, 3> moved(const std::array<std::uint32_t, 3>& corners, std::uint32_t by) {
  return {corners[0] + by, corners[1] + by, corners[2] + by};
}

}  // namespace

double volume(const Solid& solid) {
  if (solid.empty()) return 0.0;
  const Point origin = solid.points[solid.triangles[0][0]];
  double sum = 0.0;
  for (const auto& [a, b, c] : solid.triangles)
    sum += dot(solid.points[a] - origin, cross(solid.points[b] - origin, solid.points[c] - origin));
  return sum / 6.0;
}

double surface_area(const Solid& solid) {
  double sum = 0.0;
  for (const auto& [a, b, c] : solid.triangles)
    sum += norm(cross(solid.points[b] - solid.points[a], solid.points[c] - solid.points[a]));
  return sum / 2.0;
}

Box box_of(const Solid& solid) {
  Box box;
  for (const Point& p : solid.points) box.add(p);
  return box;
}

bool is_closed(const Solid& solid) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> walks;
  for (const auto& corners : solid.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corners[k];
      const std::uint32_t b = corners[(k + 1) % 3];
      walks[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return !walks.empty() && std::all_of(walks.begin(), walks.end(), [](const auto& walk) { return walk.second == 0; });
}

void add_face(Solid& solid, std::span<const std::vector<Point>> loops) {
  const auto plane = plane_of_loops(loops);
  if (!plane) return;
  const auto first = static_cast<std::uint32_t>(solid.points.size());
  if (loops.size() == 1 && loops[0].size() == 3) {
    solid.points.insert(solid.points.end(), loops[0].begin(), loops[0].end());
    solid.triangles.push_back({first, first + 1, first + 2});
    return;
  }
  const FilledFace face = fill(loops, *plane);
  solid.points.insert(solid.points.end(), face.points.begin(), face.points.end());
  for (const auto& corners : face.triangles) solid.triangles.push_back(moved(corners, first));
}

Solid prism(std::span<const std::vector<Point>> loops, const Vector& extrusion) {
  Solid solid;
  const auto plane = plane_of_loops(loops);
  if (!plane) return solid;
  const FilledFace face = fill(loops, *plane);
  const auto count = static_cast<std::uint32_t>(face.points.size());
  solid.points = face.points;
  for (const Point& p : face.points) solid.points.push_back(p + extrusion);
  for (const auto& [a, b, c] : face.triangles) {
    solid.triangles.push_back({a, c, b});
    solid.triangles.push_back({a + count, b + count, c + count});
  }
  for (const auto& [a, b] : face.rim) {
    solid.triangles.push_back({a, b, b + count});
    solid.triangles.push_back({a, b + count, a + count});
  }
  if (dot(plane->frame.w, extrusion) < 0.0)
    for (auto& corners : solid.triangles) std::swap(corners[1], corners[2]);
  return solid;
}

void append(Solid& to, const Solid& from) {
  const auto first = static_cast<std::uint32_t>(to.points.size());
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  for (const auto& corners : from.triangles) to.triangles.push_back(moved(corners, first));
}

Solid transformed(Solid solid, const Affine& map) {
  for (Point& p : solid.points) p = map(p);
  if (map.determinant() < 0.0)
    for (auto& corners : solid.triangles) std::swap(corners[1], corners[2]);
  return solid;
}

Solid snapped(const Solid& solid) {
  const auto on_grid = [](double x) { return std::round(x / kSolidGrid) * kSolidGrid; };
  std::map<std::array<double, 3>, std::uint32_t> places;
  std::vector<std::uint32_t> place_of(solid.points.size());
  Solid result;
  for (std::size_t i = 0; i < solid.points.size(); ++i) {
    const Point p{on_grid(solid.points[i].x), on_grid(solid.points[i].y), on_grid(solid.points[i].z)};
    const auto [at, is_new] =
        places.emplace(std::array{p.x, p.y, p.z}, static_cast<std::uint32_t>(result.points.size()));
    if (is_new) result.points.push_back(p);
    place_of[i] = at->second;
  }
  for (const auto& [a, b, c] : solid.triangles) {
    const std::array<std::uint32_t, 3> corners{place_of[a], place_of[b], place_of[c]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    result.triangles.push_back(corners);
  }
  return result;
}

Solid outward(Solid solid) {
  if (is_closed(solid) && volume(solid) < 0.0)
    for (auto& corners : solid.triangles) std::swap(corners[1], corners[2]);
  return solid;
}

std::vector<Solid> connected_pieces(const Solid& solid) {
  DisjointSets<std::uint32_t> joined(solid.points.size());
  for (const auto& [a, b, c] : solid.triangles) {
    joined.join(a, b);
    joined.join(a, c);
  }
  std::map<std::uint32_t, std::size_t> piece_of;
  std::vector<Solid> pieces;
  std::vector<std::uint32_t> new_index(solid.points.size(), 0);
  std::vector<bool> placed(solid.points.size(), false);
  for (const auto& corners : solid.triangles) {
    const auto [at, is_new] = piece_of.emplace(joined.root(corners[0]), pieces.size());
    if (is_new) pieces.emplace_back();
    Solid& piece = pieces[at->second];
    std::array<std::uint32_t, 3> own{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!placed[corners[k]]) {
        placed[corners[k]] = true;
        new_index[corners[k]] = static_cast<std::uint32_t>(piece.points.size());
        piece.points.push_back(solid.points[corners[k]]);
      }
      own[k] = new_index[corners[k]];
    }
    piece.triangles.push_back(own);
  }
  return pieces;
}

}  // namespace clerestory::mesh
