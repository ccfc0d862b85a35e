// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/element_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lighting/discontinuities.h"
#include "lighting/scene.h"
#include "mesh/element_tree.h"
#include "mesh/shadow_regions.h"

namespace clerestory::lighting {

using mesh::FaceId;
using mesh::FaceSide;
using mesh::Point;
using mesh::Side;

namespace {

/// Longest edge of the start elements [m]: as in a run, where the solver splits them on.
constexpr double kStartSizeM = 1e9;

/// Longest edge and least angle of a triangle.
std::array<float, 2> shape_of(const std::array<Point, 3>& c) {
  double longest = 0.0;
  double least = std::numbers::pi;
  for (std::size_t k = 0; k < 3; ++k) {
    const mesh::Vector to_next = c[(k + 1) % 3] - c[k];
    const mesh::Vector to_last = c[(k + 2) % 3] - c[k];
    longest = std::max(longest, norm(to_next));
    least = std::min(least, std::atan2(norm(cross(to_next, to_last)), dot(to_next, to_last)));
  }
  return {static_cast<float>(longest), static_cast<float>(least * 180.0 / std::numbers::pi)};
}

class ElementWriter {
 public:
  ElementWriter(const Scene& scene, const mesh::Triangulation& start, const std::vector<mesh::Shade>& shades)
      : scene_(scene), start_(start), shades_(shades), tree_(scene.faces, start, scene.has_elements) {}

  ElementMesh write() {
    for (const Point& p : start_.vertices) result_.points.push_back(p + scene_.faces.origin);
    for (std::uint32_t f = 0; f < scene_.faces.count(); ++f) {
      for (std::uint32_t t = start_.starts[f]; t < start_.starts[f + 1]; ++t) {
        for (const Side side : {Side::kFront, Side::kBack}) add({FaceId(f), side}, t);
      }
    }
    result_.part_names = scene_.faces.part_names;
    result_.material_names = scene_.faces.material_names;
    return std::move(result_);
  }

 private:
  void add(FaceSide side, std::uint32_t index) {
    if (scene_.has_elements[side.index()] == 0) return;
    const mesh::Triangle& t = start_.triangles[index];
    const mesh::Face& face = scene_.faces.faces[side.face.index()];
    std::array<std::uint32_t, 3> cell = t.vertices;
    if (side.side == Side::kBack) std::swap(cell[1], cell[2]);
    const std::array<Point, 3> corners{start_.vertices[cell[0]], start_.vertices[cell[1]], start_.vertices[cell[2]]};
    const Point middle = corners[0] + (corners[1] - corners[0] + (corners[2] - corners[0])) / 3.0;
    const auto [size, angle] = shape_of(corners);
    result_.cells.push_back(cell);
    result_.side.push_back(static_cast<std::uint8_t>(side.side));
    result_.level.push_back(tree_.level(tree_.find(side, t.region, middle)));
    result_.size_m.push_back(size);
    result_.min_angle_deg.push_back(angle);
    result_.part.push_back(static_cast<std::int32_t>(face.part.value));
    result_.material.push_back(static_cast<std::int32_t>(face.material.value));
    result_.face.push_back(static_cast<std::int32_t>(side.face.value));
    result_.region.push_back(static_cast<std::int32_t>(t.region));
    result_.patch.push_back(static_cast<std::int32_t>(t.patch));
    result_.shade.push_back(static_cast<std::uint8_t>(shades_[2 * index + static_cast<std::size_t>(side.side)]));
  }

  const Scene& scene_;
  const mesh::Triangulation& start_;
  const std::vector<mesh::Shade>& shades_;
  mesh::ElementTree tree_;
  ElementMesh result_;
};

}  // namespace

MeshedStudy mesh_study(const Study& study, bool lines_only, Progress& progress) {
  progress.phase("cleaning the model");
  const Scene scene = build_scene(study, &progress);
  progress.phase("shadow lines");
  LineOptions line_options;
  line_options.tolerance = study.accuracy.target;
  const SceneLines found = find_discontinuities(scene, line_options);
  MeshedStudy result;
  result.lines = element_lines(scene, found);
  result.selection = found.selection;
  result.notices = scene.notices;
  result.notices.insert(result.notices.end(), found.notices.begin(), found.notices.end());
  if (lines_only) return result;

  progress.phase("meshing");
  std::vector<mesh::FaceLine> lines;
  for (const mesh::DiscontinuityLine& line : found.lines) lines.push_back({line.face, line.ends});
  mesh::MeshOptions options;
  options.max_size_m = kStartSizeM;
  options.lines = lines;
  const mesh::Triangulation start = mesh::mesh_faces(scene.faces, options, &result.report);
  const std::vector<mesh::Shade> shades = mesh::shade_patches(scene.faces, start, *scene.rays, found.sources.sources);
  result.elements = ElementWriter(scene, start, shades).write();
  return result;
}

}  // namespace clerestory::lighting
