// SPDX-License-Identifier: GPL-3.0-or-later
// Corefinement alone: no other file takes so long to compile.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Surface_mesh.h>

#include <functional>

#include "mesh/solids.h"

namespace clerestory::mesh {

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh to_mesh(const Solid& solid) {
  const Solid body = snapped(solid);
  std::vector<Kernel::Point_3> points;
  for (const Point& p : body.points) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::vector<std::size_t>> triangles;
  for (const auto& [a, b, c] : body.triangles) triangles.push_back({a, b, c});
  PMP::orient_polygon_soup(points, triangles);
  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  PMP::remove_degenerate_faces(mesh);
  return mesh;
}

Solid to_solid(const Mesh& mesh) {
  Solid solid;
  std::vector<std::uint32_t> index(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), 0);
  for (const auto v : mesh.vertices()) {
    index[v] = static_cast<std::uint32_t>(solid.points.size());
    const Kernel::Point_3& p = mesh.point(v);
    solid.points.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
  }
  for (const auto f : mesh.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) corners[k++] = index[v];
    solid.triangles.push_back(corners);
  }
  return snapped(solid);
}

bool bounds_a_volume(Mesh& mesh) { return !mesh.is_empty() && CGAL::is_closed(mesh) && CGAL::is_triangle_mesh(mesh); }

using Boolean = std::function<bool(Mesh& a, Mesh& b, Mesh& result)>;

std::optional<Solid> combined(const Solid& body, const Solid& tool, const Boolean& boolean) {
  Mesh a = to_mesh(body);
  Mesh b = to_mesh(tool);
  if (!bounds_a_volume(a) || !bounds_a_volume(b)) return std::nullopt;
  Mesh result;
  try {
    if (!boolean(a, b, result)) return std::nullopt;
  } catch (const PMP::Corefinement::Self_intersection_exception&) {
    return std::nullopt;
  }
  return to_solid(result);
}

auto strict() { return CGAL::parameters::throw_on_self_intersection(true); }

}  // namespace

std::optional<Solid> difference(const Solid& body, const Solid& tool) {
  return combined(body, tool, [](Mesh& a, Mesh& b, Mesh& result) {
    return PMP::corefine_and_compute_difference(a, b, result, strict());
  });
}

std::optional<Solid> intersection(const Solid& body, const Solid& tool) {
  return combined(body, tool, [](Mesh& a, Mesh& b, Mesh& result) {
    return PMP::corefine_and_compute_intersection(a, b, result, strict());
  });
}

std::optional<Solid> united(const Solid& body, const Solid& tool) {
  return combined(body, tool, [](Mesh& a, Mesh& b, Mesh& result) {
    return PMP::corefine_and_compute_union(a, b, result, strict());
  });
}

std::optional<Solid> clipped(const Solid& shell, const Solid& tool) {
  Mesh sheet = to_mesh(shell);
  Mesh volume = to_mesh(tool);
  if (sheet.is_empty() || !bounds_a_volume(volume)) return std::nullopt;
  PMP::reverse_face_orientations(volume);  // keeps what lies outside
  try {
    if (!PMP::clip(sheet, volume, strict())) return std::nullopt;
  } catch (const PMP::Corefinement::Self_intersection_exception&) {
    return std::nullopt;
  }
  return to_solid(sheet);
}

}  // namespace clerestory::mesh
