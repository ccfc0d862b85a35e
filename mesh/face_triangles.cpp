// SPDX-License-Identifier: GPL-3.0-or-later
#include <unordered_map>
#include <utility>

#include "mesh/face_drafts.h"
#include "mesh/triangulate.h"

namespace clerestory::mesh {

namespace {
/// Slivers narrower than this share of the plane tolerance come from rounding: points and lines of a face lie farther apart.
constexpr double kSliverOverTolerance = 0.1;
}  // namespace

double triangulate_face(FaceDrafts& drafts, const FaceDraft& face, std::vector<Triangle>& triangles) {
  PlanarGraph graph;
  std::vector<std::uint32_t> vertices;
  std::unordered_map<std::uint32_t, std::uint32_t> index;
  const auto local = [&](std::uint32_t vertex) {
    const auto [place, fresh] = index.try_emplace(vertex, static_cast<std::uint32_t>(vertices.size()));
    if (fresh) {
      vertices.push_back(vertex);
      graph.points.push_back(face.plane.project(drafts.vertices[vertex]));
    }
    return place->second;
  };
  std::vector<DirectedEdge> boundary;
  for (const auto& [a, b] : face.boundary) {
    const std::uint32_t from = local(a);
    boundary.push_back({from, local(b)});
  }
  graph.segments.assign(boundary.begin(), boundary.end());
  for (const auto& [a, b] : face.lines) {
    const std::uint32_t from = local(a);
    graph.segments.push_back({from, local(b)});
  }
  const PlanarMesh mesh = triangulate_inside(std::move(graph), boundary, kSliverOverTolerance * drafts.tolerance);
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
