// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/refine.h"

// The middle of an edge is rounded, and may lie beyond a sliver that is beside the edge: what CGAL asserts not to happen does, without harm but
// where a triangle is turned over by it, which is looked for at the end.
#define CGAL_NO_ASSERTIONS
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clerestory::mesh {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Info of a vertex (its number) or face (its component), none until it is given.
struct Number {
  std::uint32_t value = kNone;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>;
using FaceInfo = CGAL::Triangulation_face_base_with_info_2<Number, Kernel>;
using ConstrainedFace = CGAL::Constrained_triangulation_face_base_2<Kernel, FaceInfo>;
using Cells = CGAL::Delaunay_mesh_face_base_2<Kernel, ConstrainedFace>;
using Structure = CGAL::Triangulation_data_structure_2<Vertices, Cells>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;
using SizeCriteria = CGAL::Delaunay_mesh_size_criteria_2<Cdt>;

/// Edges shorter than this cannot be halved often enough before coordinates run out of digits [m].
constexpr double kShortestEdge = 1e-8;

/// The longest edge of a triangle where its middle is.
using SizeAt = std::function<double(const Point2&)>;

/// Angle and size, and how short the edges have become: the mesher judges every triangle that it makes.
class Criteria : public SizeCriteria {
 public:
  Criteria(double squared_sine, double max_edge, const SizeAt* size_at, double* shortest)
      : SizeCriteria(squared_sine, max_edge), size_at_(size_at), shortest_(shortest) {}

  class Is_bad : public SizeCriteria::Is_bad {  // NOLINT(readability-identifier-naming): CGAL's word
   public:
    Is_bad(const SizeCriteria::Is_bad& base, const SizeAt* size_at, double* shortest)
        : SizeCriteria::Is_bad(base), size_at_(size_at), shortest_(shortest) {}

    CGAL::Mesh_2::Face_badness operator()(const Quality quality) const {
      return SizeCriteria::Is_bad::operator()(quality);
    }
    CGAL::Mesh_2::Face_badness operator()(const Cdt::Face_handle& face, Quality& quality) const {
      double longest = 0.0;
      Point2 middle{0.0, 0.0};
      for (int k = 0; k < 3; ++k) {
        const Kernel::Point_2& a = face->vertex(Cdt::ccw(k))->point();
        const Kernel::Point_2& b = face->vertex(Cdt::cw(k))->point();
        const double length = std::hypot(b.x() - a.x(), b.y() - a.y());
        *shortest_ = std::min(*shortest_, length);
        longest = std::max(longest, length);
        middle = {middle.x + a.x() / 3.0, middle.y + a.y() / 3.0};
      }
      if (*size_at_ && longest > (*size_at_)(middle)) {
        quality.first = 1.0;  // an angle that is none of the bad ones: the size is what is bad
        quality.second = std::numeric_limits<double>::max();
        return CGAL::Mesh_2::IMPERATIVELY_BAD;
      }
      return SizeCriteria::Is_bad::operator()(face, quality);
    }

   private:
    const SizeAt* size_at_;
    double* shortest_;
  };

  [[nodiscard]] Is_bad is_bad_object() const { return {SizeCriteria::is_bad_object(), size_at_, shortest_}; }

 private:
  const SizeAt* size_at_;
  double* shortest_;
};

using Mesher = CGAL::Delaunay_mesher_2<Cdt, Criteria>;

bool has_edge_too_short(const PlanarMesh& mesh) {
  const auto too_short = [&](const PlanarTriangle& t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2& a = mesh.points[t.vertices[k]];
      const Point2& b = mesh.points[t.vertices[(k + 1) % 3]];
      if (std::hypot(b.x - a.x, b.y - a.y) < kShortestEdge) return true;
    }
    return false;
  };
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), too_short);
}

Cdt build(const PlanarMesh& mesh) {
  Cdt cdt;
  std::vector<Cdt::Vertex_handle> handles(mesh.points.size());
  Cdt::Face_handle hint;
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i) {
    handles[i] = cdt.insert(Kernel::Point_2(mesh.points[i].x, mesh.points[i].y), hint);
    handles[i]->info().value = i;
    hint = handles[i]->face();
  }
  for (const PlanarTriangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if ((t.constrained >> k & 1U) != 0) {
        cdt.insert_constraint(handles[t.vertices[k]], handles[t.vertices[(k + 1) % 3]]);
      }
    }
  }
  return cdt;
}

void number_component(Cdt& cdt, const Kernel::Point_2& seed, std::uint32_t component) {
  std::vector<Cdt::Face_handle> front{cdt.locate(seed)};
  front.back()->info().value = component;
  while (!front.empty()) {
    const Cdt::Face_handle face = front.back();
    front.pop_back();
    for (int k = 0; k < 3; ++k) {
      const Cdt::Face_handle next = face->neighbor(k);
      if (face->is_constrained(k) || cdt.is_infinite(next) || next->info().value != kNone) continue;
      next->info().value = component;
      front.push_back(next);
    }
  }
}

/// Nothing where a triangle is turned over.
std::optional<PlanarMesh> extract(Cdt& cdt, const PlanarMesh& coarse, const std::vector<Kernel::Point_2>& seeds) {
  PlanarMesh mesh;
  mesh.points = coarse.points;
  mesh.component_count = coarse.component_count;
  for (const Cdt::Vertex_handle vertex : cdt.finite_vertex_handles()) {
    if (vertex->info().value != kNone) continue;
    vertex->info().value = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back({vertex->point().x(), vertex->point().y()});
  }
  for (const Cdt::Face_handle face : cdt.all_face_handles()) face->info().value = kNone;
  for (std::uint32_t c = 0; c < seeds.size(); ++c) number_component(cdt, seeds[c], c);
  for (const Cdt::Face_handle face : cdt.finite_face_handles()) {
    if (face->info().value == kNone) continue;
    if (cdt.orientation(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point()) !=
        CGAL::COUNTERCLOCKWISE)
      return std::nullopt;
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

}  // namespace

std::optional<PlanarMesh> refine(const PlanarMesh& mesh, const RefineOptions& options) {
  if (has_edge_too_short(mesh)) return std::nullopt;
  Cdt cdt = build(mesh);
  std::vector<Kernel::Point_2> seeds;
  for (const Point2& p : component_middles(mesh)) seeds.emplace_back(p.x, p.y);
  // CGAL bounds the squared sine of the smallest angle.
  const double sine = std::sin(options.min_angle_deg * std::acos(-1.0) / 180.0);
  double shortest = std::numeric_limits<double>::infinity();
  Mesher mesher(cdt, Criteria(sine * sine, options.max_edge, &options.max_edge_at, &shortest));
  mesher.set_seeds(seeds.begin(), seeds.end(), true);
  mesher.init();
  while (!mesher.is_refinement_done()) {
    mesher.step_by_step_refine_mesh();
    if (cdt.number_of_vertices() > options.max_vertices || shortest < kShortestEdge) return std::nullopt;
  }
  return extract(cdt, mesh, seeds);
}

}  // namespace clerestory::mesh
