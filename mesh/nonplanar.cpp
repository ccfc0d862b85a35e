// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/nonplanar.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mesh/triangulate.h"

namespace clerestory::mesh {

namespace {

double deviation(const Soup& soup, const SoupPolygon& polygon, const Plane& plane) {
  double largest = 0.0;
  for_each_edge(polygon, [&](std::uint32_t corner, std::uint32_t) {
    largest = std::max(largest, std::abs(plane.distance(soup.points[corner])));
  });
  return largest;
}

/// The corners of a polygon in its plane, with the vertex that each is.
struct FlatPolygon {
  PlanarGraph graph;
  std::vector<std::uint32_t> vertices;
};

FlatPolygon flatten(const Soup& soup, const SoupPolygon& polygon, const Plane& plane) {
  const PlaneCoordinates coordinates{plane.origin, frame_around(plane.normal)};
  FlatPolygon flat;
  std::map<std::uint32_t, std::uint32_t> index;
  const auto number = [&](std::uint32_t vertex) {
    const auto [place, fresh] = index.try_emplace(vertex, static_cast<std::uint32_t>(flat.vertices.size()));
    if (fresh) {
      flat.vertices.push_back(vertex);
      flat.graph.points.push_back(coordinates.project(soup.points[vertex]));
    }
    return place->second;
  };
  for_each_edge(polygon, [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t first = number(a);
    flat.graph.segments.push_back({first, number(b)});
  });
  return flat;
}

/// The polygon's triangles; none where its sides cross in the plane, so that they would need a vertex more.
std::vector<SoupPolygon> triangles_of(const Soup& soup, const SoupPolygon& polygon, const Plane& plane) {
  const FlatPolygon flat = flatten(soup, polygon, plane);
  const PlanarMesh mesh = triangulate_inside(flat.graph, flat.graph.segments, 0.0);
  std::vector<SoupPolygon> triangles;
  if (mesh.points.size() != flat.vertices.size()) return triangles;
  for (const PlanarTriangle& t : mesh.triangles) {
    SoupPolygon triangle;
    triangle.loops.push_back(
        {flat.vertices[t.vertices[0]], flat.vertices[t.vertices[1]], flat.vertices[t.vertices[2]]});
    triangle.material = polygon.material;
    triangle.part = polygon.part;
    triangle.source = polygon.source;
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
    const auto plane = plane_of(soup.points, polygon, 0.0);
    std::vector<SoupPolygon> triangles;
    if (plane && deviation(soup, polygon, *plane) > tolerance) triangles = triangles_of(soup, polygon, *plane);
    if (triangles.empty()) {
      result.push_back(std::move(polygon));
      continue;
    }
    changed = true;
    defects.add("non-planar polygons", polygon.source, soup.points[polygon.loops[0][0]]);
    for (SoupPolygon& triangle : triangles) result.push_back(std::move(triangle));
  }
  soup.polygons = std::move(result);
  return changed;
}

}  // namespace clerestory::mesh
