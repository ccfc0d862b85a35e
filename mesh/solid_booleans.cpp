// SPDX-License-Identifier: GPL-3.0-or-later
// Corefinement alone: no other file takes so long to compile.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

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

/// Whether an edge is the wrong one of the two diagonals of coplanar triangles: not Delaunay or, where all four corners lie on one
/// circle, not the one from the first of them in lexicographic order.
bool is_wrong_diagonal(const Mesh& mesh, Mesh::Halfedge_index h) {
  if (mesh.is_border(mesh.edge(h))) return false;
  const Kernel::Point_3& a = mesh.point(mesh.source(h));
  const Kernel::Point_3& b = mesh.point(mesh.target(h));
  const Kernel::Point_3& c = mesh.point(mesh.target(mesh.next(h)));
  const Kernel::Point_3& d = mesh.point(mesh.target(mesh.next(mesh.opposite(h))));
  if (!CGAL::coplanar(a, b, c, d) || CGAL::collinear(a, b, c)) return false;
  if (CGAL::coplanar_orientation(a, b, c, d) != CGAL::NEGATIVE) return false;
  const CGAL::Bounded_side side = CGAL::coplanar_side_of_bounded_circle(a, b, c, d);
  if (side != CGAL::ON_BOUNDARY) return side == CGAL::ON_BOUNDED_SIDE;
  return std::min(c, d) < std::min(a, b);
}

/// Gives what is flat the one triangulation that depends on nothing but its corners [Lawson 1977; ties by lowering the first corner in
/// the lifting]. Corefinement breaks ties by the addresses of its boxes.
void triangulate_anew(Mesh& mesh) {
  std::vector<Mesh::Halfedge_index> to_check;
  for (const auto e : mesh.edges()) to_check.push_back(mesh.halfedge(e));
  while (!to_check.empty()) {
    const Mesh::Halfedge_index h = to_check.back();
    to_check.pop_back();
    if (!is_wrong_diagonal(mesh, h)) continue;
    CGAL::Euler::flip_edge(h, mesh);
    for (const auto side : {h, mesh.opposite(h)}) {
      to_check.push_back(mesh.next(side));
      to_check.push_back(mesh.prev(side));
    }
  }
}

/// The solid with corners and triangles in lexicographic order.
Solid ordered(const Solid& solid) {
  const auto key = [&](std::uint32_t i) {
    const Point& p = solid.points[i];
    return std::array{p.x, p.y, p.z};
  };
  std::vector<std::uint32_t> order(solid.points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
  Solid result;
  std::vector<std::uint32_t> index(order.size());
  for (const std::uint32_t i : order) {
    index[i] = static_cast<std::uint32_t>(result.points.size());
    result.points.push_back(solid.points[i]);
  }
  for (const auto& [a, b, c] : solid.triangles) {
    std::array corners{index[a], index[b], index[c]};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.triangles.push_back(corners);
  }
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

Solid to_solid(Mesh& mesh) {
  triangulate_anew(mesh);
  Solid solid;
  std::vector<std::uint32_t> index(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), 0);
  for (const auto v : mesh.vertices()) {
    index[v] = static_cast<std::uint32_t>(solid.points.size());
    // Of the exact coordinates: the intervals around them depend on the way that led there.
    const auto& p = CGAL::exact(mesh.point(v));
    solid.points.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
  }
  for (const auto f : mesh.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) corners[k++] = index[v];
    solid.triangles.push_back(corners);
  }
  return ordered(snapped(solid));
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
