// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/surface_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

#include "lighting/parallel.h"
#include "mesh/smooth_regions.h"
#include "mesh/vertex_index.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;

namespace {

/// Corners closer than this are one point [m].
constexpr double kGrain = 1e-6;
/// The same where they belong to different faces, which rounded them in their own planes by up to twice the plane tolerance.
constexpr double kGrainOfFaces = 5e-5;
/// Normals of a limit surface that differ by less are those of one smooth point, seen from two patches: cosine of 1 degree.
constexpr double kSmoothCosine = 0.99985;

/// Start triangles of an element: itself, or those of its group.
void triangles_of(const mesh::ElementTree& tree, ElementId e, std::vector<ElementId>& found) {
  if (tree.is_triangle(e)) {
    found.push_back(e);
    return;
  }
  for (std::size_t k = 0; k < tree.child_count(e); ++k) {
    triangles_of(tree, ElementId(tree.first_child(e).index() + k), found);
  }
}

class SurfaceWriter {
 public:
  SurfaceWriter(const Solution& solution, const SolutionErrors& errors)
      : solution_(solution),
        errors_(errors),
        tree_(solution.tree()),
        surface_of_(mesh::smooth_regions(solution.scene().faces)) {
    result_.part_names = solution.scene().faces.part_names;
    result_.material_names = solution.scene().faces.material_names;
    for (const mesh::Room& room : solution.scene().rooms.rooms) result_.room_names.push_back(room.name);
  }

  SurfaceResult write() {
    for (const ElementId e : solution_.elements()) {
      std::vector<ElementId> triangles;
      triangles_of(tree_, e, triangles);
      const ElementId root = tree_.root(e);
      for (const ElementId t : triangles) add_cell(e, t, root);
    }
    find_rooms();
    for (std::size_t i = 0; i < result_.points.size(); ++i) {
      result_.point_illuminance_lux.push_back(static_cast<float>(sums_[i] / weights_[i]));
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] double illuminance_at(ElementId e, const Point& p) const {
    const Vector d = p - tree_.centroid(e);
    const auto values = solution_.irradiance(e);
    double sum = 0.0;
    for (std::size_t c = 0; c < values.size(); ++c) {
      sum += solution_.scene().channel_weights[c] * (values[c].value + values[c].slope_u * dot(d, tree_.axes(e).u) +
                                                     values[c].slope_v * dot(d, tree_.axes(e).v));
    }
    return std::max(0.0, sum);
  }

  std::uint32_t add_point(const Point& p, const Vector& normal) {
    result_.points.push_back(p + solution_.scene().faces.origin);
    result_.point_normals.push_back(normal);
    sums_.push_back(0.0);
    weights_.push_back(0.0);
    return static_cast<std::uint32_t>(result_.points.size() - 1);
  }

  /// The number of a root among the roots of its side: its region.
  [[nodiscard]] std::size_t region_of(ElementId root) const {
    const auto roots = tree_.roots_of(tree_.face_side(root));
    return static_cast<std::size_t>(std::find(roots.begin(), roots.end(), root) - roots.begin());
  }

  /// A point of a curved part: one for all elements of that side of one smooth surface whose normals agree there.
  std::uint32_t curved_point(ElementId root, const mesh::LimitPoint& limit) {
    const mesh::FaceSide side = tree_.face_side(root);
    const Vector normal = side.side == mesh::Side::kBack ? -limit.normal : limit.normal;
    const std::array<std::uint32_t, 3> key{places_.add(limit.at), static_cast<std::uint32_t>(side.side),
                                           surface_of_[side.face.index()][region_of(root)]};
    std::vector<std::uint32_t>& known = curved_points_[key];
    for (const std::uint32_t point : known) {
      if (dot(result_.point_normals[point], normal) > kSmoothCosine) return point;
    }
    known.push_back(add_point(limit.at, normal));
    return known.back();
  }

  std::uint32_t point_of(ElementId root, const Point& p) {
    if (const auto limit = solution_.scene().faces.limit(tree_.face_side(root).face, p))
      return curved_point(root, *limit);
    const auto grid = [](double x) { return static_cast<std::int64_t>(std::llround(x / kGrain)); };
    const std::array<std::int64_t, 4> key{root.value, grid(p.x), grid(p.y), grid(p.z)};
    const auto [entry, added] = points_.try_emplace(key, static_cast<std::uint32_t>(result_.points.size()));
    if (added) add_point(p, tree_.normal(root));
    return entry->second;
  }

  void add_cell(ElementId element, ElementId triangle, ElementId root) {
    const Scene& scene = solution_.scene();
    const mesh::FaceSide side = tree_.face_side(element);
    const mesh::Face& face = scene.faces.faces[side.face.index()];
    std::array<std::uint32_t, 3> cell{};
    const auto corners = tree_.corners(triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      cell[k] = point_of(root, corners[k]);
      sums_[cell[k]] += tree_.area(triangle) * illuminance_at(element, corners[k]);
      weights_[cell[k]] += tree_.area(triangle);
    }
    const auto lux = static_cast<float>(illuminance_at(element, tree_.centroid(triangle)));
    const float rho = luminance(scene.side_reflectance(side), scene.channel_weights);
    const float own = luminance(scene.side_exitance(side), scene.channel_weights);
    float radiosity = own;
    for (std::size_t c = 0; c < scene.channels; ++c) {
      radiosity += scene.channel_weights[c] * solution_.radiosity_at(element, tree_.centroid(triangle), c, false);
    }
    result_.cells.push_back(cell);
    result_.side.push_back(static_cast<std::uint8_t>(side.side));
    result_.illuminance_lux.push_back(lux);
    result_.error_lux.push_back(static_cast<float>(errors_.point_error(solution_, element)));
    result_.radiosity_lm_m2.push_back(radiosity);
    result_.luminance_cd_m2.push_back(radiosity / std::numbers::pi_v<float>);
    result_.reflectance.push_back(rho);
    result_.level.push_back(tree_.level(triangle));
    result_.part.push_back(static_cast<std::int32_t>(face.part.value));
    result_.material.push_back(static_cast<std::int32_t>(face.material_of(side.side).value));
    looks_.push_back({tree_.centroid(triangle), tree_.normal(element)});
  }

  void find_rooms() {
    const Scene& scene = solution_.scene();
    result_.room.resize(looks_.size());
    parallel_for(
        looks_.size(),
        [&](std::size_t i) {
          const auto& [at, normal] = looks_[i];
          const std::uint32_t room = mesh::room_before(scene.rooms, *scene.rays, at, normal);
          result_.room[i] = room == mesh::kNoRoom ? -1 : static_cast<std::int32_t>(room);
        },
        256);
  }

  const Solution& solution_;
  const SolutionErrors& errors_;
  const mesh::ElementTree& tree_;
  SurfaceResult result_;
  std::map<std::array<std::int64_t, 4>, std::uint32_t> points_;
  mesh::VertexIndex places_{kGrainOfFaces};             // of curved parts
  std::vector<std::vector<std::uint32_t>> surface_of_;  // [faces][regions] of curved parts
  std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> curved_points_;
  std::vector<std::pair<Point, Vector>> looks_;  // centroid and normal of each cell
  std::vector<double> sums_;
  std::vector<double> weights_;
};

}  // namespace

SurfaceResult surface_values(const Solution& solution, const SolutionErrors& errors) {
  return SurfaceWriter(solution, errors).write();
}

}  // namespace clerestory::lighting
