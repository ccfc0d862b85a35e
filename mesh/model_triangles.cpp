// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model_triangles.h"

#include "mesh/flat_graph.h"
#include "mesh/soup.h"
#include "mesh/triangulate.h"

namespace clerestory::mesh {

namespace {

bool is_cut(const SoupPolygon& polygon, CutPolygons which) {
  if (polygon.loops.size() > 1) return true;
  return which == CutPolygons::kWithMoreThanThreeCorners && polygon.loops[0].size() > 3;
}

/// Appends a polygon's triangles, and the points that they need.
void cut(const SoupPolygon& polygon, Model& result) {
  const auto plane = plane_of(result.vertices, polygon, 0.0);
  if (!plane) return;
  const PlaneCoordinates coordinates{plane->origin, frame_around(plane->normal)};
  FlatGraph flat(result.vertices, coordinates);
  for_each_edge(polygon, [&](std::uint32_t a, std::uint32_t b) { flat.add(a, b); });
  const PlanarMesh mesh = triangulate_inside(flat.graph(), flat.graph().segments, 0.0);
  std::vector<std::uint32_t> vertices = flat.vertices();
  for (std::size_t added = vertices.size(); added < mesh.points.size(); ++added) {
    vertices.push_back(static_cast<std::uint32_t>(result.vertices.size()));
    result.vertices.push_back(coordinates.lift(mesh.points[added]));
  }
  for (const PlanarTriangle& triangle : mesh.triangles) {
    result.begin_polygon(polygon.material, polygon.part, polygon.line);
    result.add_loop(
        std::array{vertices[triangle.vertices[0]], vertices[triangle.vertices[1]], vertices[triangle.vertices[2]]});
  }
}

}  // namespace

Model cut_into_triangles(const Model& model, CutPolygons which) {
  Model result;
  result.vertices = model.vertices;
  result.material_names = model.material_names;
  result.part_names = model.part_names;
  for (const SoupPolygon& polygon : to_soup(model).polygons) {
    if (is_cut(polygon, which)) {
      cut(polygon, result);
      continue;
    }
    result.begin_polygon(polygon.material, polygon.part, polygon.line);
    result.add_loop(polygon.loops[0]);
  }
  return result;
}

}  // namespace clerestory::mesh
