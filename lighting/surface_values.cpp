// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/surface_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lighting/lit_limit.h"
#include "lighting/mesh_grading.h"
#include "lighting/parallel.h"
#include "mesh/contact_sectors.h"
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
        sectors_(solution.scene().faces),
        surface_of_(mesh::smooth_regions(solution.scene().faces)) {
    result_.part_names = solution.scene().faces.part_names;
    result_.material_names = solution.scene().faces.material_names;
    for (const mesh::Room& room : solution.scene().rooms.rooms) result_.room_names.push_back(room.name);
  }

  /// Surfaces that are shown by a mesh of their own.
  void add(const ShownMesh& shown, const LitMesh& lit) {
    shown_ = shown.shown;
    const std::size_t channels = solution_.channels();
    const auto first = static_cast<std::uint32_t>(result_.points.size());
    std::vector<double> weighted(lit.points.size(), 0.0);
    for (std::size_t i = 0; i < lit.points.size(); ++i) {
      add_point(lit.points[i], {});
      weighted[i] = luminance_of(std::span(lit.lux).subspan(i * channels, channels));
      sums_.back() = weighted[i];
      weights_.back() = 1.0;
    }
    for (const LitMesh::Cell& cell : lit.cells) {
      std::array<std::uint32_t, 3> points{};
      double lux = 0.0;
      double error2 = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        points[k] = first + cell.points[k];
        result_.point_normals[points[k]] = tree_.normal(cell.element);
        lux += weighted[cell.points[k]] / 3.0;
        error2 += lit.error_lux[cell.points[k]] * lit.error_lux[cell.points[k]] / 3.0;
      }
      add_values(points, cell.element, cell.middle, tree_.level(cell.element));
      result_.error_lux.push_back(static_cast<float>(std::sqrt(error2)));
      result_.illuminance_lux.push_back(static_cast<float>(lux));
      add_radiosity(radiosity_of(cell, lit));
    }
  }

  /// Surfaces that are shown by the elements of the solution.
  void add_elements() {
    for (const ElementId e : solution_.elements()) {
      if (is_shown(tree_.face_side(e))) continue;
      std::vector<ElementId> triangles;
      triangles_of(tree_, e, triangles);
      const ElementId root = tree_.root(e);
      for (const ElementId t : triangles) add_cell(e, t, root);
    }
  }

  /// What could be lit better than by the solution: the points of curved parts.
  [[nodiscard]] std::span<const LimitPlace> limit_places() const { return limit_places_; }
  /// @param light  [limit places] nothing where the solution's stays
  void light_curved(std::span<const std::optional<LocalPass::Light>> light) {
    std::map<std::uint32_t, const LocalPass::Light*> lit;
    for (std::size_t i = 0; i < light.size(); ++i) {
      if (!light[i]) continue;
      const std::uint32_t point = limit_points_[i];
      lit[point] = &*light[i];
      sums_[point] = luminance_of(light[i]->lux);
      weights_[point] = 1.0;
    }
    for (const CurvedCell& cell : curved_cells_) light_cell(cell, lit);
  }

  SurfaceResult finish() {
    find_rooms();
    for (std::size_t i = 0; i < result_.points.size(); ++i) sums_[i] /= weights_[i];
    anchor();
    result_.point_illuminance_lux.assign(sums_.begin(), sums_.end());
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

  [[nodiscard]] double luminance_of(std::span<const double> lux) const {
    return luminance(lux, solution_.scene().channel_weights);
  }

  /// A cell of a curved part, whose light is that of its points.
  struct CurvedCell {
    std::size_t cell = 0;
    ElementId element;
  };

  void light_cell(const CurvedCell& cell, const std::map<std::uint32_t, const LocalPass::Light*>& lit) {
    const mesh::FaceSide side = tree_.face_side(cell.element);
    const Scene& scene = solution_.scene();
    double lux = 0.0;
    double error2 = 0.0;
    float radiosity = own_radiosity(side);
    for (const std::uint32_t point : result_.cells[cell.cell]) {
      const auto found = lit.find(point);
      if (found == lit.end()) return;
      lux += luminance_of(found->second->lux) / 3.0;
      error2 += found->second->error_lux * found->second->error_lux / 3.0;
      for (std::size_t c = 0; c < scene.channels; ++c) {
        radiosity += scene.channel_weights[c] * scene.side_reflectance(side)[c] *
                     static_cast<float>(found->second->lux[c] / 3.0);
      }
    }
    result_.illuminance_lux[cell.cell] = static_cast<float>(lux);
    result_.error_lux[cell.cell] = static_cast<float>(std::sqrt(error2));
    result_.radiosity_lm_m2[cell.cell] = radiosity;
    result_.luminance_cd_m2[cell.cell] = radiosity / std::numbers::pi_v<float>;
  }

  /// Place, side and smooth surface.
  [[nodiscard]] std::array<std::uint32_t, 3> curved_key(ElementId root, std::uint32_t place) const {
    const mesh::FaceSide side = tree_.face_side(root);
    return {place, static_cast<std::uint32_t>(side.side), surface_of_[side.face.index()][region_of(root)]};
  }

  [[nodiscard]] std::optional<std::uint32_t> with_normal(std::span<const std::uint32_t> points,
                                                         const Vector& normal) const {
    for (const std::uint32_t point : points) {
      if (dot(result_.point_normals[point], normal) > kSmoothCosine) return point;
    }
    return std::nullopt;
  }

  /// The point of the limit surface that a point of a curved face stands for, its normal that of the side; nothing where the face is flat.
  [[nodiscard]] std::optional<mesh::LimitPoint> limit_of(ElementId root, const Point& p) const {
    const mesh::FaceSide side = tree_.face_side(root);
    auto limit = solution_.scene().faces.limit(side.face, p);
    if (limit && side.side == mesh::Side::kBack) limit->normal = -limit->normal;
    return limit;
  }

  /// A point of a curved part: one for all elements of that side of one smooth surface whose normals agree there.
  /// @param place  the element that asks, and where in it; its limit's normal is that of the side
  std::uint32_t curved_point(ElementId root, const LimitPlace& place) {
    const mesh::LimitPoint& limit = place.limit;
    const Vector& normal = limit.normal;
    std::vector<std::uint32_t>& known = curved_points_[curved_key(root, places_.add(limit.at))];
    if (const auto point = with_normal(known, normal)) return *point;
    known.push_back(add_point(limit.at, normal));
    limit_places_.push_back(place);
    limit_points_.push_back(known.back());
    return known.back();
  }

  /// A corner of a cell with that middle: one for all cells of a region, but for those on the other side of a contact.
  std::uint32_t point_of(ElementId element, ElementId root, const Point& p, const Point& middle) {
    if (const auto limit = limit_of(root, p)) return curved_point(root, {element, inside_from(p, middle), *limit});
    const std::array<std::uint32_t, 3> key{root.value, sectors_.at(tree_.face_side(root).face, p, middle),
                                           flat_places_.add(p)};
    const auto [entry, added] = points_.try_emplace(key, static_cast<std::uint32_t>(result_.points.size()));
    if (added) add_point(p, tree_.normal(root));
    return entry->second;
  }

  /// An edge of a cell, and the middle of the cell; in the plane of its face.
  struct Edge {
    ElementId root;
    std::array<std::uint32_t, 2> points;
    std::array<Point, 2> ends;
    Point middle;
  };

  /// Where small cells meet a large one, their points on its edge get what its edge has there, and on curved parts its place: so there are no
  /// cracks [Baum, Mann, Smith, Winget 1991]. The large ones go first, as ends of their edges may hang on larger ones.
  void anchor() {
    const auto length = [](const Edge& edge) { return norm(edge.ends[1] - edge.ends[0]); };
    std::stable_sort(edges_.begin(), edges_.end(), [&](const Edge& a, const Edge& b) { return length(a) > length(b); });
    for (const Edge& edge : edges_) anchor(edge);
  }

  void anchor(const Edge& edge) {
    const Point at = midpoint(edge.ends[0], edge.ends[1]);
    const auto found = hanging_at(edge, at);
    if (!found) return;
    const auto [a, b] = edge.points;
    sums_[*found] = 0.5 * (sums_[a] + sums_[b]);
    result_.points[*found] = midpoint(result_.points[a], result_.points[b]);
    anchor({edge.root, {a, *found}, {edge.ends[0], at}, edge.middle});
    anchor({edge.root, {*found, b}, {at, edge.ends[1]}, edge.middle});
  }

  /// The point of smaller cells that stands for the middle of an edge.
  [[nodiscard]] std::optional<std::uint32_t> hanging_at(const Edge& edge, const Point& at) const {
    if (const auto limit = limit_of(edge.root, at)) {
      const auto place = places_.find(limit->at);
      if (!place) return std::nullopt;
      const auto found = curved_points_.find(curved_key(edge.root, *place));
      return found == curved_points_.end() ? std::nullopt : with_normal(found->second, limit->normal);
    }
    const auto place = flat_places_.find(at);
    if (!place) return std::nullopt;
    const auto found =
        points_.find({edge.root.value, sectors_.at(tree_.face_side(edge.root).face, at, edge.middle), *place});
    return found == points_.end() ? std::nullopt : std::optional(found->second);
  }

  void add_cell(ElementId element, ElementId triangle, ElementId root) {
    std::array<std::uint32_t, 3> cell{};
    const auto corners = tree_.corners(triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      cell[k] = point_of(element, root, corners[k], tree_.centroid(triangle));
      sums_[cell[k]] += tree_.area(triangle) * illuminance_at(element, corners[k]);
      weights_[cell[k]] += tree_.area(triangle);
    }
    const bool curved = !solution_.scene().faces.faces[tree_.face_side(root).face.index()].facets.empty();
    // A flat region that is one element is shown by a conforming triangulation: nothing hangs on its edges, which are most of a large scene's.
    for (std::size_t k = 0; k < 3 && (curved || element != root); ++k) {
      const std::size_t next = (k + 1) % 3;
      edges_.push_back({root, {cell[k], cell[next]}, {corners[k], corners[next]}, tree_.centroid(triangle)});
    }
    if (curved) curved_cells_.push_back({result_.cells.size(), element});
    const Point& middle = tree_.centroid(triangle);
    const float radiosity =
        own_radiosity(tree_.face_side(element)) + solution_.luminous_radiosity_at(element, middle, false);
    add_values(cell, element, middle, tree_.level(triangle));
    result_.error_lux.push_back(static_cast<float>(errors_.point_error(solution_, element)));
    result_.illuminance_lux.push_back(static_cast<float>(illuminance_at(element, middle)));
    add_radiosity(radiosity);
  }

  /// All of a cell but its light and the error of that.
  void add_values(const std::array<std::uint32_t, 3>& cell, ElementId element, const Point& middle, int level) {
    const Scene& scene = solution_.scene();
    const mesh::FaceSide side = tree_.face_side(element);
    const mesh::Face& face = scene.faces.faces[side.face.index()];
    result_.cells.push_back(cell);
    result_.side.push_back(static_cast<std::uint8_t>(side.side));
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

  [[nodiscard]] bool is_shown(mesh::FaceSide side) const { return !shown_.empty() && shown_[side.index()] != 0; }

  [[nodiscard]] float radiosity_of(const LitMesh::Cell& cell, const LitMesh& lit) const {
    const mesh::FaceSide side = tree_.face_side(cell.element);
    float radiosity = own_radiosity(side);
    for (std::size_t c = 0; c < solution_.channels(); ++c) {
      double lux = 0.0;
      for (const std::uint32_t p : cell.points) lux += lit.lux[p * solution_.channels() + c] / 3.0;
      radiosity +=
          solution_.scene().channel_weights[c] * solution_.scene().side_reflectance(side)[c] * static_cast<float>(lux);
    }
    return radiosity;
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
  mesh::VertexIndex flat_places_{kGrain};
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> points_;  // root, sector and place
  std::vector<Edge> edges_;
  mesh::ContactSectors sectors_;
  mesh::VertexIndex places_{kGrainOfFaces};             // of curved parts
  std::vector<std::vector<std::uint32_t>> surface_of_;  // [faces][regions] of curved parts
  std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> curved_points_;
  std::vector<LimitPlace> limit_places_;
  std::vector<std::uint32_t> limit_points_;  // [limit places] points of the result
  std::vector<CurvedCell> curved_cells_;
  std::vector<std::pair<Point, Vector>> looks_;  // centroid and normal of each cell
  std::vector<double> sums_;                     // by weight, of points; at last their values
  std::vector<double> weights_;
  std::span<const std::uint8_t> shown_;  // [sides] non-zero where they are no elements of the solution
};

}  // namespace

SurfaceResult surface_values(const Solution& solution, const SolutionErrors& errors) {
  SurfaceWriter writer(solution, errors);
  writer.add_elements();
  return writer.finish();
}

SurfaceResult surface_values(const Solution& solution, const SolutionErrors& errors, const ShownMesh& shown,
                             const LitMesh& lit, const LocalPass& local, Progress& progress) {
  SurfaceWriter writer(solution, errors);
  writer.add(shown, lit);
  writer.add_elements();
  writer.light_curved(light_limit(local, writer.limit_places(), progress));
  return writer.finish();
}

}  // namespace clerestory::lighting
