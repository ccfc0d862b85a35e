// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangulate.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <limits>

namespace clerestory::mesh {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Info of a vertex or face: its number, none until it is given.
struct Number {
  std::uint32_t value = kNone;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>;
using FaceInfo = CGAL::Triangulation_face_base_with_info_2<Number, Kernel>;
using Cells = CGAL::Constrained_triangulation_face_base_2<Kernel, FaceInfo>;
using Structure = CGAL::Triangulation_data_structure_2<Vertices, Cells>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

Cdt build(const PlanarGraph& graph) {
  Cdt cdt;
  std::vector<Cdt::Vertex_handle> handles;
  handles.reserve(graph.points.size());
  Cdt::Face_handle hint;
  for (std::uint32_t i = 0; i < graph.points.size(); ++i) {
    const Cdt::Vertex_handle vertex = cdt.insert(Kernel::Point_2(graph.points[i].x, graph.points[i].y), hint);
    if (vertex->info().value == kNone) vertex->info().value = i;
    handles.push_back(vertex);
    hint = vertex->face();
  }
  for (const auto& [a, b] : graph.segments) {
    if (handles[a] != handles[b]) cdt.insert_constraint(handles[a], handles[b]);
  }
  return cdt;
}

/// Numbers the faces by components that constrained edges part.
std::uint32_t number_components(Cdt& cdt) {
  std::uint32_t count = 0;
  std::vector<Cdt::Face_handle> front;
  for (const Cdt::Face_handle seed : cdt.finite_face_handles()) {
    if (seed->info().value != kNone) continue;
    seed->info().value = count;
    front.push_back(seed);
    while (!front.empty()) {
      const Cdt::Face_handle face = front.back();
      front.pop_back();
      for (int k = 0; k < 3; ++k) {
        const Cdt::Face_handle next = face->neighbor(k);
        if (face->is_constrained(k) || cdt.is_infinite(next) || next->info().value != kNone) continue;
        next->info().value = count;
        front.push_back(next);
      }
    }
    ++count;
  }
  return count;
}

}  // namespace

PlanarMesh triangulate(const PlanarGraph& graph) {
  Cdt cdt = build(graph);
  PlanarMesh mesh;
  mesh.points = graph.points;
  for (const Cdt::Vertex_handle vertex : cdt.finite_vertex_handles()) {
    if (vertex->info().value != kNone) continue;
    vertex->info().value = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back({vertex->point().x(), vertex->point().y()});
  }
  if (cdt.dimension() < 2) return mesh;
  mesh.component_count = number_components(cdt);
  for (const Cdt::Face_handle face : cdt.finite_face_handles()) {
    PlanarTriangle triangle;
    for (int k = 0; k < 3; ++k) {
      triangle.vertices[static_cast<std::size_t>(k)] = face->vertex(k)->info().value;
      // CGAL's edge k lies opposite vertex k: it begins at vertex k + 1.
      if (face->is_constrained(Cdt::cw(k))) triangle.constrained |= static_cast<std::uint8_t>(1U << k);
    }
    triangle.component = face->info().value;
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

std::vector<Point2> component_middles(const PlanarMesh& mesh) {
  std::vector<double> largest(mesh.component_count, 0.0);
  std::vector<Point2> middles(mesh.component_count);
  for (const PlanarTriangle& t : mesh.triangles) {
    const Point2& a = mesh.points[t.vertices[0]];
    const Point2& b = mesh.points[t.vertices[1]];
    const Point2& c = mesh.points[t.vertices[2]];
    const double area = doubled_area(a, b, c);
    if (area <= largest[t.component]) continue;
    largest[t.component] = area;
    middles[t.component] = {(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0};
  }
  return middles;
}

}  // namespace clerestory::mesh
