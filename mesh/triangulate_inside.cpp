// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/triangulate.h"

namespace clerestory::mesh {

namespace {

/// The widest triangle of a component: it is what tells where the component lies.
struct Widest {
  double width = 0.0;  ///< the least height of the triangle [m]
  Point2 centre;
};

std::vector<Widest> widest_triangles(const PlanarMesh& mesh) {
  std::vector<Widest> widest(mesh.component_count);
  for (const PlanarTriangle& t : mesh.triangles) {
    const Point2& a = mesh.points[t.vertices[0]];
    const Point2& b = mesh.points[t.vertices[1]];
    const Point2& c = mesh.points[t.vertices[2]];
    const double longest = std::max(
        {std::hypot(b.x - a.x, b.y - a.y), std::hypot(c.x - b.x, c.y - b.y), std::hypot(a.x - c.x, a.y - c.y)});
    const double width = doubled_area(a, b, c) / longest;
    if (width <= widest[t.component].width) continue;
    widest[t.component] = {width, {(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0}};
  }
  return widest;
}

}  // namespace

PlanarMesh triangulate_inside(const PlanarGraph& graph, std::span<const std::array<std::uint32_t, 2>> boundary,
                              double min_width) {
  constexpr std::uint32_t kOutside = std::numeric_limits<std::uint32_t>::max();
  std::vector<PlanarOutline::Segment> segments;
  for (const auto& [a, b] : boundary) segments.push_back({graph.points[a], graph.points[b]});
  const PlanarOutline outline(std::move(segments));

  PlanarMesh mesh = triangulate(graph);
  std::vector<std::uint32_t> number(mesh.component_count, kOutside);
  std::uint32_t count = 0;
  const std::vector<Widest> widest = widest_triangles(mesh);
  for (std::size_t c = 0; c < widest.size(); ++c) {
    if (widest[c].width > min_width && outline.winding(widest[c].centre) != 0) number[c] = count++;
  }
  std::erase_if(mesh.triangles, [&](const PlanarTriangle& t) { return number[t.component] == kOutside; });
  for (PlanarTriangle& t : mesh.triangles) t.component = number[t.component];
  mesh.component_count = count;
  return mesh;
}

}  // namespace clerestory::mesh
