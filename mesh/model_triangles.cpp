// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model_triangles.h"

#include <utility>

#include "mesh/flat_graph.h"
#include "mesh/simple_pieces.h"
#include "mesh/soup.h"
#include "mesh/triangulate.h"

namespace clerestory::mesh {

namespace {

/// What is narrower lies between points that are on one line but for rounding [m].
constexpr double kNoWidth = 1e-9;

enum class Pieces { kTriangles, kWithoutHoles };

bool is_cut(const SoupPolygon& polygon, Pieces pieces) {
  return polygon.loops.size() > 1 || (pieces == Pieces::kTriangles && polygon.loops[0].size() > 3);
}

std::vector<std::vector<std::uint32_t>> loops_of(const PlanarMesh& mesh, Pieces pieces) {
  if (pieces == Pieces::kWithoutHoles) return simple_pieces(mesh);
  std::vector<std::vector<std::uint32_t>> loops;
  for (const PlanarTriangle& t : mesh.triangles) loops.emplace_back(t.vertices.begin(), t.vertices.end());
  return loops;
}

/// Appends a polygon's pieces, and the points that they need.
void cut(const SoupPolygon& polygon, Pieces pieces, Model& result) {
  const auto plane = plane_of(result.vertices, polygon, 0.0);
  if (!plane) return;
  const PlaneCoordinates coordinates{plane->origin, frame_around(plane->normal)};
  FlatGraph flat(result.vertices, coordinates);
  for_each_edge(polygon, [&](std::uint32_t a, std::uint32_t b) { flat.add(a, b); });
  const PlanarMesh mesh = triangulate_inside(flat.graph(), flat.graph().segments, kNoWidth);
  std::vector<std::uint32_t> vertices = flat.vertices();
  for (std::size_t added = vertices.size(); added < mesh.points.size(); ++added) {
    vertices.push_back(static_cast<std::uint32_t>(result.vertices.size()));
    result.vertices.push_back(coordinates.lift(mesh.points[added]));
  }
  for (std::vector<std::uint32_t>& loop : loops_of(mesh, pieces)) {
    for (std::uint32_t& corner : loop) corner = vertices[corner];
    result.begin_polygon(polygon.material, polygon.part, polygon.line);
    result.add_loop(loop);
  }
}

Model cut_model(const Model& model, Pieces pieces) {
  Model result;
  result.vertices = model.vertices;
  result.material_names = model.material_names;
  result.part_names = model.part_names;
  for (const SoupPolygon& polygon : to_soup(model).polygons) {
    if (is_cut(polygon, pieces)) {
      cut(polygon, pieces, result);
      continue;
    }
    result.begin_polygon(polygon.material, polygon.part, polygon.line);
    result.add_loop(polygon.loops[0]);
  }
  return result;
}

}  // namespace

Model cut_into_triangles(const Model& model) { return cut_model(model, Pieces::kTriangles); }

Model cut_at_holes(const Model& model) { return cut_model(model, Pieces::kWithoutHoles); }

}  // namespace clerestory::mesh
