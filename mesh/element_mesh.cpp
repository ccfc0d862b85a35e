// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/face_lines.h"
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
/// A point this near to an edge was put on it [m].
constexpr double kOnEdge = 1e-9;
/// Vertices allowed for a face: by input vertex, and by area over that of an element of the greatest size. Good meshes need
/// some 5 and 4; beyond this the input has features too close for the angle bound.
constexpr std::size_t kVerticesPerInput = 100;
constexpr double kVerticesPerElement = 40.0;
/// … and so many more where sizes are given place by place.
constexpr std::size_t kVerticesBySize = 20000;

/// A face that is narrower on the mean keeps its coarse triangles [m]: the angle bound would cut it into pieces of its width, much smaller than
/// light ever asks for. Strips that close the gap below what stands on a face are a tenth of that.
constexpr double kNarrowest = 0.002;

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

bool is_narrow(const PlanarMesh& mesh, double area) {
  double longest = 0.0;
  for (const Point2& p : mesh.points)
    longest = std::max(longest, std::hypot(p.x - mesh.points[0].x, p.y - mesh.points[0].y));
  return area < kNarrowest * longest;
}

/// The longest edge of an element at a point of a face's plane [m]; may be empty.
using SizeInPlane = std::function<double(const Point2&)>;

/// The mesh of a face within the bounds; nothing where it or its details are too fine for them (a frame of 6 mm round a wall of 10 m: every
/// edge would be split to that width, whatever the angle bound).
std::optional<PlanarMesh> refined(const PlanarMesh& coarse, double area, const SizeInPlane& size_at,
                                  const MeshOptions& options) {
  if (is_narrow(coarse, area)) return std::nullopt;
  RefineOptions refinement;
  refinement.max_edge_at = size_at;
  refinement.max_edge = options.max_size_m;
  refinement.min_angle_deg = options.min_angle_deg;
  const double elements = area / (options.max_size_m * options.max_size_m);
  refinement.max_vertices = 1000 + kVerticesPerInput * coarse.points.size() +
                            static_cast<std::size_t>(kVerticesPerElement * elements) + (size_at ? kVerticesBySize : 0);
  return refine(coarse, refinement);
}

/// A face's mesh, and the one that it was refined from.
struct FaceMesh {
  LinedMesh coarse;
  PlanarMesh fine;
};

/// The coarsest mesh that has the lines.
FaceMesh coarse_face(const PlanarMesh& shape, std::span<const std::array<Point2, 2>> lines, double line_distance_m,
                     MeshReport& report) {
  FaceMesh face{with_lines(shape, lines, line_distance_m), {}};
  if (face.coarse.left_out > 0) ++report.faces_with_fewer_lines;
  face.fine = face.coarse.mesh;
  return face;
}

/// Where the lines are too fine the mesh is one without them; where the face is, it keeps its coarse triangles.
FaceMesh refined_face(const PlanarMesh& shape, double area, std::span<const std::array<Point2, 2>> lines,
                      const SizeInPlane& size_at, const MeshOptions& options, MeshReport& report) {
  FaceMesh face{with_lines(shape, lines, options.line_distance_m), {}};
  std::optional<PlanarMesh> fine = refined(face.coarse.mesh, area, size_at, options);
  bool all_in = face.coarse.left_out == 0;
  if (!fine && !lines.empty()) {
    all_in = false;
    face.coarse = with_lines(shape, {}, options.line_distance_m);
    fine = refined(face.coarse.mesh, area, size_at, options);
  }
  if (!all_in) ++report.faces_with_fewer_lines;
  face.fine = fine ? std::move(*fine) : face.coarse.mesh;
  return face;
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

/// Where input edges meet at angles that are too small for the bound: a vertex, and the far ends of its constrained edges.
struct SmallInputAngle {
  Point2 apex;
  std::vector<Point2> ends;
};

/// Whether constrained edges leave a vertex at a small angle to each other.
bool has_small_angle(const SmallInputAngle& at) {
  std::vector<double> directions;
  for (const Point2& end : at.ends) {
    directions.push_back(std::atan2(end.y - at.apex.y, end.x - at.apex.x) * kDegrees);
  }
  std::sort(directions.begin(), directions.end());
  double before = directions.back() - 360.0;
  bool small = false;
  for (const double direction : directions) {
    small = small || (direction - before < kSmallInputAngle && directions.size() > 1);
    before = direction;
  }
  return small;
}

std::vector<SmallInputAngle> small_input_angles(const PlanarMesh& coarse) {
  std::vector<std::set<std::uint32_t>> across(coarse.points.size());
  for (const PlanarTriangle& t : coarse.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if ((t.constrained >> k & 1U) == 0) continue;
      across[t.vertices[k]].insert(t.vertices[(k + 1) % 3]);
      across[t.vertices[(k + 1) % 3]].insert(t.vertices[k]);
    }
  }
  std::vector<SmallInputAngle> found;
  for (std::size_t v = 0; v < across.size(); ++v) {
    if (across[v].size() < 2) continue;
    SmallInputAngle at{coarse.points[v], {}};
    for (const std::uint32_t end : across[v]) at.ends.push_back(coarse.points[end]);
    if (has_small_angle(at)) found.push_back(std::move(at));
  }
  return found;
}

/// Whether a triangle stands on one of the edges at a small angle. Points that would mend it encroach on such edges, and splitting those would
/// not come to an end [Shewchuk 2002].
bool stands_on(const SmallInputAngle& angle, const Point2& point) {
  return std::any_of(angle.ends.begin(), angle.ends.end(), [&](const Point2& end) {
    const double dx = end.x - angle.apex.x;
    const double dy = end.y - angle.apex.y;
    const double length = std::hypot(dx, dy);
    const double along = ((point.x - angle.apex.x) * dx + (point.y - angle.apex.y) * dy) / length;
    return along >= -kOnEdge && along <= length + kOnEdge &&
           std::abs(doubled_area(angle.apex, end, point)) <= kOnEdge * length;
  });
}

bool is_excused(const PlanarMesh& mesh, const PlanarTriangle& t, const std::vector<SmallInputAngle>& angles) {
  return std::any_of(angles.begin(), angles.end(), [&](const SmallInputAngle& angle) {
    return std::any_of(t.vertices.begin(), t.vertices.end(),
                       [&](std::uint32_t v) { return stands_on(angle, mesh.points[v]); });
  });
}

void judge(const PlanarMesh& coarse, const PlanarMesh& mesh, const MeshOptions& options, MeshReport& report) {
  const std::vector<SmallInputAngle> small = small_input_angles(coarse);
  report.triangles += mesh.triangles.size();
  for (const PlanarTriangle& t : mesh.triangles) {
    const std::array<double, 3> angles = angles_deg(mesh, t);
    const double least = *std::min_element(angles.begin(), angles.end());
    report.min_angle_deg = std::min(report.min_angle_deg, least);
    if (least >= options.min_angle_deg - kAngleRounding) continue;
    ++report.small_angles;
    if (is_excused(mesh, t, small)) ++report.small_input_angles;
  }
}

/// Appends a face's triangles; its vertices lie in its plane exactly, and are not shared with other faces.
/// @param region_of_patch  the regions to which the mesh's components belong
void append(const PlanarMesh& mesh, const PlaneCoordinates& plane, std::span<const std::uint32_t> region_of_patch,
            Triangulation& result) {
  const auto first = static_cast<std::uint32_t>(result.vertices.size());
  for (const Point2& p : mesh.points) result.vertices.push_back(plane.lift(p));
  for (const PlanarTriangle& t : mesh.triangles) {
    Triangle triangle{t.vertices, t.constrained, region_of_patch[t.component], t.component};
    for (std::uint32_t& v : triangle.vertices) v += first;
    result.triangles.push_back(triangle);
  }
  result.starts.push_back(static_cast<std::uint32_t>(result.triangles.size()));
}

/// The places in the list of each face's lines, in order.
std::vector<std::vector<std::uint32_t>> lines_by_face(const Faces& faces, std::span<const FaceLine> lines) {
  std::vector<std::vector<std::uint32_t>> by_face(faces.count());
  for (std::uint32_t i = 0; i < lines.size(); ++i) by_face[lines[i].face.index()].push_back(i);
  return by_face;
}

}  // namespace

Triangulation mesh_faces(const Faces& faces, const MeshOptions& options, MeshReport* report) {
  Triangulation result;
  MeshReport told;
  const auto by_face = lines_by_face(faces, options.lines);
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (!options.wanted.empty() && options.wanted[f] == 0) {
      result.starts.push_back(static_cast<std::uint32_t>(result.triangles.size()));
      continue;
    }
    const PlaneCoordinates plane{faces.faces[f].origin, faces.faces[f].frame};
    SizeInPlane size_at;
    if (options.size_at) size_at = [&](const Point2& p) { return options.size_at(FaceId(f), plane.lift(p)); };
    std::vector<std::array<Point2, 2>> lines;
    for (const std::uint32_t i : by_face[f]) {
      lines.push_back({plane.project(options.lines[i].ends[0]), plane.project(options.lines[i].ends[1])});
    }
    const PlanarMesh shape = in_plane(faces, FaceId(f));
    const bool refines = options.refined.empty() || options.refined[f] != 0;
    const FaceMesh face = refines ? refined_face(shape, faces.faces[f].area_m2, lines, size_at, options, told)
                                  : coarse_face(shape, lines, options.line_distance_m, told);
    told.lines += lines.size();
    told.lines_merged += face.coarse.merged;
    told.line_length_m += face.coarse.length_m;
    judge(face.coarse.mesh, face.fine, options, told);
    append(face.fine, plane, face.coarse.region_of_patch, result);
  }
  if (report != nullptr) *report = told;
  return result;
}

}  // namespace clerestory::mesh
