// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/faces.h"
#include "mesh/planar.h"
#include "mesh/refine.h"

namespace clerestory::mesh {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
/// The angle bound does not hold next to input angles below this [degrees; Shewchuk 2002 proves 60, practice knows 40].
constexpr double kSmallInputAngle = 40.0;
/// Rounding of an angle at the bound [degrees].
constexpr double kAngleRounding = 0.01;
/// Vertices allowed for a face: by input vertex, and by area over that of an element of the greatest size. Good meshes need
/// some 5 and 4; beyond this the input has features too close for the angle bound.
constexpr std::size_t kVerticesPerInput = 100;
constexpr double kVerticesPerElement = 40.0;

/// One face in its plane; points are numbered as triangles first use them.
PlanarMesh in_plane(const Faces& faces, FaceId id) {
  const Face& face = faces.faces[id.index()];
  const PlaneCoordinates plane{face.origin, face.frame};
  PlanarMesh mesh;
  std::unordered_map<std::uint32_t, std::uint32_t> index;
  for (const Triangle& t : faces.shape.of(id)) {
    PlanarTriangle triangle{{}, t.constrained, t.region};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [place, fresh] = index.try_emplace(t.vertices[k], static_cast<std::uint32_t>(mesh.points.size()));
      if (fresh) mesh.points.push_back(plane.project(faces.shape.vertices[t.vertices[k]]));
      triangle.vertices[k] = place->second;
    }
    mesh.component_count = std::max(mesh.component_count, t.region + 1);
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

/// The face's mesh within the bounds; as it is where details are too fine for them (a frame of 6 mm round a wall of 10 m: every
/// edge would be split to that width, whatever the angle bound).
PlanarMesh refined(const PlanarMesh& coarse, double area, const MeshOptions& options) {
  RefineOptions refinement;
  refinement.max_edge = options.max_size_m;
  refinement.min_angle_deg = options.min_angle_deg;
  const double elements = area / (options.max_size_m * options.max_size_m);
  refinement.max_vertices =
      1000 + kVerticesPerInput * coarse.points.size() + static_cast<std::size_t>(kVerticesPerElement * elements);
  return refine(coarse, refinement).value_or(coarse);
}

std::array<double, 3> angles_deg(const PlanarMesh& mesh, const PlanarTriangle& t) {
  std::array<double, 3> angles{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Point2& a = mesh.points[t.vertices[k]];
    const Point2& b = mesh.points[t.vertices[(k + 1) % 3]];
    const Point2& c = mesh.points[t.vertices[(k + 2) % 3]];
    const double cosine = (b.x - a.x) * (c.x - a.x) + (b.y - a.y) * (c.y - a.y);
    angles[k] = std::atan2(doubled_area(a, b, c), cosine) * kDegrees;
  }
  return angles;
}

/// The input vertices at which two constrained edges meet at a small angle.
std::vector<bool> small_input_angles(const PlanarMesh& coarse) {
  std::vector<std::set<double>> directions(coarse.points.size());
  for (const PlanarTriangle& t : coarse.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if ((t.constrained >> k & 1U) == 0) continue;
      const std::uint32_t a = t.vertices[k];
      const std::uint32_t b = t.vertices[(k + 1) % 3];
      const double dx = coarse.points[b].x - coarse.points[a].x;
      const double dy = coarse.points[b].y - coarse.points[a].y;
      directions[a].insert(std::atan2(dy, dx) * kDegrees);
      directions[b].insert(std::atan2(-dy, -dx) * kDegrees);
    }
  }
  std::vector<bool> small(directions.size(), false);
  for (std::size_t v = 0; v < directions.size(); ++v) {
    if (directions[v].size() < 2) continue;
    double before = *directions[v].rbegin() - 360.0;
    for (const double direction : directions[v]) {
      const double angle = direction - before;
      // An edge between two triangles comes twice, equal but for rounding.
      small[v] = small[v] || (angle > 1e-6 && angle < kSmallInputAngle);
      before = direction;
    }
  }
  return small;
}

void judge(const PlanarMesh& coarse, const PlanarMesh& mesh, const MeshOptions& options, MeshReport& report) {
  const std::vector<bool> small_input = small_input_angles(coarse);
  report.triangles += mesh.triangles.size();
  for (const PlanarTriangle& t : mesh.triangles) {
    const std::array<double, 3> angles = angles_deg(mesh, t);
    const double least = *std::min_element(angles.begin(), angles.end());
    report.min_angle_deg = std::min(report.min_angle_deg, least);
    if (least >= options.min_angle_deg - kAngleRounding) continue;
    ++report.small_angles;
    const bool excused = std::any_of(t.vertices.begin(), t.vertices.end(),
                                     [&](std::uint32_t v) { return v < small_input.size() && small_input[v]; });
    if (excused) ++report.small_input_angles;
  }
}

/// Appends a face's triangles; its vertices lie in its plane exactly, and are not shared with other faces.
void append(const PlanarMesh& mesh, const PlaneCoordinates& plane, Triangulation& result) {
  const auto first = static_cast<std::uint32_t>(result.vertices.size());
  for (const Point2& p : mesh.points) result.vertices.push_back(plane.lift(p));
  for (const PlanarTriangle& t : mesh.triangles) {
    Triangle triangle{t.vertices, t.constrained, t.component};
    for (std::uint32_t& v : triangle.vertices) v += first;
    result.triangles.push_back(triangle);
  }
  result.starts.push_back(static_cast<std::uint32_t>(result.triangles.size()));
}

}  // namespace

Triangulation mesh_faces(const Faces& faces, const MeshOptions& options, MeshReport* report) {
  Triangulation result;
  for (std::size_t f = 0; f < faces.count(); ++f) {
    const Face& face = faces.faces[f];
    const PlanarMesh coarse = in_plane(faces, FaceId(f));
    const PlanarMesh mesh = refined(coarse, face.area_m2, options);
    if (report != nullptr) judge(coarse, mesh, options, *report);
    append(mesh, {face.origin, face.frame}, result);
  }
  return result;
}

}  // namespace clerestory::mesh
