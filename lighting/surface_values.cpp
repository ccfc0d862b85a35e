// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/surface_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

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

/// Straight light at a corner of a cell is computed this far inside of it [m], or this share of the way to its middle.
constexpr double kOffCorners = 1e-4;
constexpr double kOffCornersShare = 0.1;

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

/// A point of the shadow mesh.
struct ShadedPoint {
  /// An element that meets the point in a cell of some area.
  struct Use {
    ElementId element;
    double area = 0.0;
  };

  Point at;
  Point inside;  ///< a hair inside of one of its cells
  std::vector<Use> uses;
  std::vector<double> lux;       ///< per channel
  std::vector<double> straight;  ///< of it, straight light; empty where that of the solution is as good
};

struct ShadedCell {
  std::array<Point, 3> corners;
  std::array<std::uint32_t, 3> points{};
  Point middle;
  double area = 0.0;
  ElementId element;        ///< that holds the middle
  std::vector<double> lux;  ///< mean, per channel
};

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

  SurfaceWriter(const Solution& solution, const SolutionErrors& errors, const ShadowMesh& shadows,
                const StraightLight& straight)
      : SurfaceWriter(solution, errors) {
    shadows_ = &shadows;
    straight_ = &straight;
  }

  SurfaceResult write() {
    for (const ElementId e : solution_.elements()) {
      if (is_shaded(tree_.face_side(e))) continue;
      std::vector<ElementId> triangles;
      triangles_of(tree_, e, triangles);
      const ElementId root = tree_.root(e);
      for (const ElementId t : triangles) add_cell(e, t, root);
    }
    if (shadows_ != nullptr) {
      add_shaded_cells();
      light_shaded();
    }
    find_rooms();
    for (std::size_t i = 0; i < result_.points.size(); ++i) {
      result_.point_illuminance_lux.push_back(static_cast<float>(sums_[i] / weights_[i]));
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] double illuminance_at(ElementId e, const Point& p) const {
    return std::max(0.0, solution_.illuminance_at(e, p));
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

  std::uint32_t point_of(ElementId root, const Point& p, std::uint32_t patch = 0) {
    if (const auto limit = solution_.scene().faces.limit(tree_.face_side(root).face, p))
      return curved_point(root, *limit);
    const auto grid = [](double x) { return static_cast<std::int64_t>(std::llround(x / kGrain)); };
    const std::array<std::int64_t, 5> key{root.value, patch, grid(p.x), grid(p.y), grid(p.z)};
    const auto [entry, added] = points_.try_emplace(key, static_cast<std::uint32_t>(result_.points.size()));
    if (added) add_point(p, tree_.normal(root));
    return entry->second;
  }

  void add_cell(ElementId element, ElementId triangle, ElementId root) {
    std::array<std::uint32_t, 3> cell{};
    const auto corners = tree_.corners(triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      cell[k] = point_of(root, corners[k]);
      sums_[cell[k]] += tree_.area(triangle) * illuminance_at(element, corners[k]);
      weights_[cell[k]] += tree_.area(triangle);
    }
    const Point& middle = tree_.centroid(triangle);
    float radiosity = own_radiosity(tree_.face_side(element));
    for (std::size_t c = 0; c < solution_.channels(); ++c) {
      radiosity += solution_.scene().channel_weights[c] * solution_.radiosity_at(element, middle, c, false);
    }
    add_values(cell, element, middle, tree_.level(triangle));
    result_.illuminance_lux.push_back(static_cast<float>(illuminance_at(element, middle)));
    add_radiosity(radiosity);
  }

  /// All of a cell but its light.
  void add_values(const std::array<std::uint32_t, 3>& cell, ElementId element, const Point& middle, int level) {
    const Scene& scene = solution_.scene();
    const mesh::FaceSide side = tree_.face_side(element);
    const mesh::Face& face = scene.faces.faces[side.face.index()];
    result_.cells.push_back(cell);
    result_.side.push_back(static_cast<std::uint8_t>(side.side));
    result_.error_lux.push_back(static_cast<float>(errors_.point_error(solution_, element)));
    result_.reflectance.push_back(luminance(scene.side_reflectance(side), scene.channel_weights));
    result_.level.push_back(level);
    result_.part.push_back(static_cast<std::int32_t>(face.part.value));
    result_.material.push_back(static_cast<std::int32_t>(face.material_of(side.side).value));
    looks_.push_back({middle, tree_.normal(element)});
  }

  [[nodiscard]] float own_radiosity(mesh::FaceSide side) const {
    return luminance(solution_.scene().side_exitance(side), solution_.scene().channel_weights);
  }

  void add_radiosity(float radiosity) {
    result_.radiosity_lm_m2.push_back(radiosity);
    result_.luminance_cd_m2.push_back(radiosity / std::numbers::pi_v<float>);
  }

  [[nodiscard]] bool is_shaded(mesh::FaceSide side) const {
    return shadows_ != nullptr && shadows_->lit[side.index()] != 0 && !shadows_->mesh.of(side.face).empty();
  }

  void add_shaded_cells() {
    for (std::size_t s = 0; s < 2 * solution_.scene().faces.count(); ++s) {
      const mesh::FaceSide side = mesh::face_side(s);
      if (!is_shaded(side)) continue;
      for (const mesh::Triangle& t : shadows_->mesh.of(side.face)) add_shaded_cell(side, t);
    }
  }

  void add_shaded_cell(mesh::FaceSide side, const mesh::Triangle& t) {
    std::array<std::uint32_t, 3> vertices = t.vertices;
    if (side.side == mesh::Side::kBack) std::swap(vertices[1], vertices[2]);
    ShadedCell shaded;
    for (std::size_t k = 0; k < 3; ++k) shaded.corners[k] = shadows_->mesh.vertices[vertices[k]];
    const auto& c = shaded.corners;
    shaded.middle = c[0] + (c[1] - c[0] + (c[2] - c[0])) / 3.0;
    shaded.area = 0.5 * norm(cross(c[1] - c[0], c[2] - c[0]));
    shaded.element = solution_.element_at(side, t.region, shaded.middle);
    if (!shaded.element.valid()) return;
    const ElementId root = tree_.root(shaded.element);
    const std::uint32_t patch = shadows_->jump[side.face.index()] != 0 ? t.patch + 1 : 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [entry, added] = shaded_points_.try_emplace(point_of(root, c[k], patch), ShadedPoint{});
      shaded.points[k] = entry->first;
      // Off the edges of the face, and of the patch.
      const Vector inwards = shaded.middle - c[k];
      const Point inside = c[k] + std::min(kOffCorners, kOffCornersShare * norm(inwards)) * normalized(inwards);
      entry->second.uses.push_back({solution_.element_at(side, t.region, inside), shaded.area});
      entry->second.at = c[k];
      if (added) entry->second.inside = inside;
    }
    add_values(shaded.points, shaded.element, shaded.middle, tree_.level(shaded.element));
    shaded_.push_back(shaded);
  }

  /// An element's line, without straight light unless asked for.
  [[nodiscard]] std::vector<double> rest_at(ElementId element, const Point& at, bool with_straight) const {
    const Vector d = at - tree_.centroid(element);
    std::vector<double> lux;
    const auto values = solution_.irradiance(element);
    for (std::size_t c = 0; c < values.size(); ++c) {
      lux.push_back(values[c].value + values[c].slope_u * dot(d, tree_.axes(element).u) +
                    values[c].slope_v * dot(d, tree_.axes(element).v));
      if (!with_straight) lux.back() -= straight_->in_solution(element, at, c);
    }
    return lux;
  }

  [[nodiscard]] double weighted(std::span<const double> lux) const {
    double sum = 0.0;
    for (std::size_t c = 0; c < lux.size(); ++c) sum += solution_.scene().channel_weights[c] * lux[c];
    return sum;
  }

  void light_shaded() {
    std::vector<std::pair<const std::uint32_t, ShadedPoint>*> points;
    for (auto& point : shaded_points_) points.push_back(&point);
    parallel_for(
        points.size(), [&](std::size_t i) { light(points[i]->second); }, 16);
    for (const auto* point : points) {
      sums_[point->first] = std::max(0.0, weighted(point->second.lux));
      weights_[point->first] = 1.0;
    }
    parallel_for(
        shaded_.size(), [&](std::size_t i) { light(shaded_[i]); }, 16);
    for (const ShadedCell& cell : shaded_) {
      const mesh::FaceSide side = tree_.face_side(cell.element);
      float radiosity = own_radiosity(side);
      for (std::size_t c = 0; c < cell.lux.size(); ++c) {
        radiosity += solution_.scene().channel_weights[c] * solution_.scene().side_reflectance(side)[c] *
                     static_cast<float>(std::max(0.0, cell.lux[c]));
      }
      result_.illuminance_lux.push_back(static_cast<float>(std::max(0.0, weighted(cell.lux))));
      add_radiosity(radiosity);
    }
  }

  /// The rest is the mean over the elements that meet at the point.
  void light(ShadedPoint& point) const {
    double area = 0.0;
    std::vector<double> sum(solution_.channels(), 0.0);
    const auto straight = straight_->at(point.uses.front().element, point.inside);
    for (const ShadedPoint::Use& use : point.uses) {
      const std::vector<double> rest = rest_at(use.element, point.at, !straight);
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += use.area * rest[c];
      area += use.area;
    }
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] = sum[c] / area + (straight ? (*straight)[c] : 0.0);
    point.lux = std::move(sum);
    if (straight) point.straight = *straight;
  }

  /// The mean over a cell: straight light by its corners, the rest by its middle.
  void light(ShadedCell& cell) const {
    const bool anew = std::all_of(cell.points.begin(), cell.points.end(),
                                  [&](std::uint32_t p) { return !shaded_points_.at(p).straight.empty(); });
    cell.lux = rest_at(cell.element, cell.middle, !anew);
    for (std::size_t c = 0; c < cell.lux.size() && anew; ++c) {
      for (const std::uint32_t p : cell.points) cell.lux[c] += shaded_points_.at(p).straight[c] / 3.0;
    }
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
  std::map<std::array<std::int64_t, 5>, std::uint32_t> points_;
  mesh::VertexIndex places_{kGrainOfFaces};             // of curved parts
  std::vector<std::vector<std::uint32_t>> surface_of_;  // [faces][regions] of curved parts
  std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> curved_points_;
  std::vector<std::pair<Point, Vector>> looks_;  // centroid and normal of each cell
  std::vector<double> sums_;
  std::vector<double> weights_;
  const ShadowMesh* shadows_ = nullptr;
  const StraightLight* straight_ = nullptr;
  std::map<std::uint32_t, ShadedPoint> shaded_points_;
  std::vector<ShadedCell> shaded_;
};

}  // namespace

SurfaceResult surface_values(const Solution& solution, const SolutionErrors& errors) {
  return SurfaceWriter(solution, errors).write();
}

SurfaceResult surface_values(const Solution& solution, const SolutionErrors& errors, const ShadowMesh& shadows,
                             const StraightLight& straight) {
  return SurfaceWriter(solution, errors, shadows, straight).write();
}

}  // namespace clerestory::lighting
