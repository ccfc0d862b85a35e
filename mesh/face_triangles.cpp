// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/face_drafts.h"
#include "mesh/flat_graph.h"
#include "mesh/triangulate.h"

namespace clerestory::mesh {

namespace {
/// Slivers narrower than this share of the plane tolerance come from rounding: points and lines of a face lie farther apart.
constexpr double kSliverOverTolerance = 0.1;
}  // namespace

double triangulate_face(FaceDrafts& drafts, const FaceDraft& face, std::vector<Triangle>& triangles) {
  FlatGraph flat(drafts.vertices.points(), face.plane);
  std::vector<DirectedEdge> boundary;
  for (const auto& [a, b] : face.boundary) boundary.push_back(flat.add(a, b));
  for (const auto& [a, b] : face.lines) flat.add(a, b);
  const PlanarMesh mesh = triangulate_inside(flat.graph(), boundary, kSliverOverTolerance * drafts.tolerance);
  std::vector<std::uint32_t> vertices = flat.vertices();
  for (std::size_t i = vertices.size(); i < mesh.points.size(); ++i) {
    vertices.push_back(drafts.vertices.append(face.plane.lift(mesh.points[i])));
  }
  double area = 0.0;
  for (const PlanarTriangle& t : mesh.triangles) {
    triangles.push_back(
        {{vertices[t.vertices[0]], vertices[t.vertices[1]], vertices[t.vertices[2]]}, t.constrained, t.component});
    area += 0.5 * doubled_area(mesh.points[t.vertices[0]], mesh.points[t.vertices[1]], mesh.points[t.vertices[2]]);
  }
  return area;
}

}  // namespace clerestory::mesh
