// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/surface_values.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

#include "lighting/parallel.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;

namespace {

/// Corners closer than this are one point [m].
constexpr double kGrain = 1e-6;

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
  explicit SurfaceWriter(const Solution& solution) : solution_(solution), tree_(solution.tree()) {
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

  std::uint32_t point_of(ElementId root, const Point& p) {
    const auto grid = [](double x) { return static_cast<std::int64_t>(std::llround(x / kGrain)); };
    const std::array<std::int64_t, 4> key{root.value, grid(p.x), grid(p.y), grid(p.z)};
    const auto [entry, added] = points_.try_emplace(key, static_cast<std::uint32_t>(result_.points.size()));
    if (added) {
      result_.points.push_back(p + solution_.scene().faces.origin);
      sums_.push_back(0.0);
      weights_.push_back(0.0);
    }
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
    result_.error_lux.push_back(solution_.element_error(element));
    result_.radiosity_lm_m2.push_back(radiosity);
    result_.luminance_cd_m2.push_back(radiosity / std::numbers::pi_v<float>);
    result_.reflectance.push_back(rho);
    result_.level.push_back(tree_.level(triangle));
    result_.part.push_back(static_cast<std::int32_t>(face.part.value));
    result_.material.push_back(static_cast<std::int32_t>(face.material.value));
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
  const mesh::ElementTree& tree_;
  SurfaceResult result_;
  std::map<std::array<std::int64_t, 4>, std::uint32_t> points_;
  std::vector<std::pair<Point, Vector>> looks_;  // centroid and normal of each cell
  std::vector<double> sums_;
  std::vector<double> weights_;
};

}  // namespace

SurfaceResult surface_values(const Solution& solution) { return SurfaceWriter(solution).write(); }

}  // namespace clerestory::lighting
