// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/nonplanar.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mesh/flat_graph.h"
#include "mesh/triangulate.h"

namespace clerestory::mesh {

namespace {

/// Marks the corners between two others that lie farther than the tolerance from the chord [Douglas, Peucker 1973].
void mark_bends(const Soup& soup, const std::vector<std::uint32_t>& loop, std::size_t first, std::size_t last,
                double tolerance, std::vector<bool>& bends) {
  const Point& a = soup.points[loop[first]];
  const Vector chord = normalized(soup.points[loop[last % loop.size()]] - a);
  std::size_t farthest = first;
  double most = tolerance;
  for (std::size_t i = first + 1; i < last; ++i) {
    const Vector offset = soup.points[loop[i]] - a;
    const double distance = norm(offset - dot(offset, chord) * chord);
    if (distance <= most) continue;
    most = distance;
    farthest = i;
  }
  if (farthest == first) return;
  bends[farthest] = true;
  mark_bends(soup, loop, first, farthest, tolerance, bends);
  mark_bends(soup, loop, farthest, last, tolerance, bends);
}

/// The loop without the corners that only divide its edges.
std::vector<std::uint32_t> bends_of(const Soup& soup, std::vector<std::uint32_t> loop, double tolerance) {
  const auto farthest_from = [&](const Point& p) {
    return std::max_element(loop.begin(), loop.end(), [&](std::uint32_t a, std::uint32_t b) {
      return norm(soup.points[a] - p) < norm(soup.points[b] - p);
    });
  };
  // Two corners that are bends for sure.
  std::rotate(loop.begin(), farthest_from(soup.points[loop[0]]), loop.end());
  const auto opposite = static_cast<std::size_t>(farthest_from(soup.points[loop[0]]) - loop.begin());
  std::vector<bool> bends(loop.size(), false);
  bends[0] = bends[opposite] = true;
  mark_bends(soup, loop, 0, opposite, tolerance, bends);
  mark_bends(soup, loop, opposite, loop.size(), tolerance, bends);
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (bends[i]) kept.push_back(loop[i]);
  }
  return kept;
}

/// The distance of the farthest corner from the mean plane [m] where it is more than the tolerance. Corners that only divide an edge do
/// not count: they were set into it with the tolerance of T-junctions, and a triangle with such corners is planar for good.
std::optional<double> warp_of(const Soup& soup, const SoupPolygon& polygon, double tolerance) {
  SoupPolygon bare;
  for (const std::vector<std::uint32_t>& loop : polygon.loops) bare.loops.push_back(bends_of(soup, loop, tolerance));
  if (bare.loops.size() == 1 && bare.loops[0].size() <= 3) return std::nullopt;
  const std::optional<Plane> plane = plane_of(soup.points, bare, 0.0);
  if (!plane) return std::nullopt;
  double largest = 0.0;
  for_each_edge(bare, [&](std::uint32_t corner, std::uint32_t) {
    largest = std::max(largest, std::abs(plane->distance(soup.points[corner])));
  });
  if (largest <= tolerance) return std::nullopt;
  return largest;
}

/// The polygon's triangles; none where its sides cross in the plane, so that they would need a vertex more.
std::vector<SoupPolygon> triangles_of(const Soup& soup, const SoupPolygon& polygon, const Plane& plane) {
  FlatGraph flat(soup.points, {plane.origin, frame_around(plane.normal)});
  for_each_edge(polygon, [&](std::uint32_t a, std::uint32_t b) { flat.add(a, b); });
  const PlanarMesh mesh = triangulate_inside(flat.graph(), flat.graph().segments, 0.0);
  const std::vector<std::uint32_t>& vertices = flat.vertices();
  std::vector<SoupPolygon> triangles;
  if (mesh.points.size() != vertices.size()) return triangles;
  for (const PlanarTriangle& t : mesh.triangles) {
    SoupPolygon triangle;
    triangle.loops.push_back({vertices[t.vertices[0]], vertices[t.vertices[1]], vertices[t.vertices[2]]});
    triangle.material = polygon.material;
    triangle.back_material = polygon.back_material;
    triangle.part = polygon.part;
    triangle.source = polygon.source;
    triangle.flipped = polygon.flipped;
    triangle.line = polygon.line;
    triangles.push_back(std::move(triangle));
  }
  return triangles;
}

}  // namespace

bool triangulate_nonplanar(Soup& soup, double tolerance, DefectList& defects) {
  std::vector<SoupPolygon> result;
  result.reserve(soup.polygons.size());
  bool changed = false;
  for (SoupPolygon& polygon : soup.polygons) {
    std::vector<SoupPolygon> triangles;
    const std::optional<double> warp = warp_of(soup, polygon, tolerance);
    if (warp) {
      if (const auto plane = plane_of(soup.points, polygon, 0.0)) triangles = triangles_of(soup, polygon, *plane);
      if (triangles.empty()) {
        defects.leave("non-planar polygons", {polygon.source, soup.points[polygon.loops[0][0]], *warp},
                      "its sides cross where it is seen along its mean normal");
      }
    }
    if (triangles.empty()) {
      result.push_back(std::move(polygon));
      continue;
    }
    changed = true;
    defects.add("non-planar polygons", {polygon.source, soup.points[polygon.loops[0][0]], *warp});
    for (SoupPolygon& triangle : triangles) result.push_back(std::move(triangle));
  }
  soup.polygons = std::move(result);
  return changed;
}

}  // namespace clerestory::mesh
