// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/near_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "mesh/box_tree.h"
#include "mesh/planar_region.h"

namespace clerestory::mesh {

namespace {

/// Faces at less than 45 degrees to each other lie before each other: none stands on the other.
const double kStandingCosine = std::sqrt(0.5);
/// Length of the foot at least, in terms of the gap.
constexpr double kLong = 2.0;

class NearContactSearch {
 public:
  NearContactSearch(FaceDrafts& drafts, const NearContactOptions& options)
      : drafts_(drafts), options_(options), count_(drafts.faces.size()), regions_(count_) {
    std::vector<Box> boxes(count_);
    for (std::size_t f = 0; f < count_; ++f) {
      for (const DirectedEdge& e : drafts.faces[f].boundary) boxes[f].add(drafts.vertices[e[0]]);
      boxes[f] = grown(boxes[f], options.gap_m);
    }
    tree_ = BoxTree(boxes);
  }

  std::size_t run() {
    for (std::size_t f = 0; f < count_; ++f) {
      if (is_passable(drafts_.faces[f])) continue;
      for (const auto& [a, b] : drafts_.faces[f].boundary) look_below(f, {drafts_.vertices[a], drafts_.vertices[b]});
    }
    std::move(strips_.begin(), strips_.end(), std::back_inserter(drafts_.faces));
    return strips_.size();
  }

 private:
  [[nodiscard]] bool is_passable(const FaceDraft& face) const {
    const std::size_t material = face.material.index();
    return material < options_.passable_materials.size() && options_.passable_materials[material];
  }

  const PlanarRegion& region(std::size_t f) {
    if (!regions_[f]) regions_[f] = region_of(drafts_, drafts_.faces[f]);
    return *regions_[f];
  }

  /// Finds the faces on which face f stands by an edge.
  void look_below(std::size_t f, const Ends& edge) {
    Box box;
    for (const Point& end : edge) box.add(end);
    std::vector<std::size_t> others;
    tree_.visit([&](const Box& other) { return overlap(box, other); },
                [&](std::uint32_t g) {
                  if (g != f && !is_passable(drafts_.faces[g]) && stands_on(f, edge, g)) others.push_back(g);
                });
    for (const std::size_t g : others) add_strips(f, edge, g);
  }

  [[nodiscard]] bool stands_on(std::size_t f, const Ends& edge, std::size_t g) const {
    const PlaneCoordinates& below = drafts_.faces[g].plane;
    const double first = below.distance(edge[0]);
    const double second = below.distance(edge[1]);
    const double width = std::max(std::abs(first), std::abs(second));
    if (width <= drafts_.tolerance || width > options_.gap_m || first * second < 0.0) return false;
    if (norm(edge[1] - edge[0]) < kLong * width) return false;
    if (std::abs(dot(drafts_.faces[f].plane.frame.w, below.frame.w)) > kStandingCosine) return false;
    const double side = first + second > 0.0 ? 1.0 : -1.0;
    const double lowest = std::min(side * first, side * second) - drafts_.tolerance;
    const std::vector<DirectedEdge>& boundary = drafts_.faces[f].boundary;
    return std::all_of(boundary.begin(), boundary.end(),
                       [&](const DirectedEdge& e) { return side * below.distance(drafts_.vertices[e[0]]) >= lowest; });
  }

  /// Strips below those stretches of the edge whose feet lie inside face g.
  void add_strips(std::size_t f, const Ends& edge, std::size_t g) {
    const PlaneCoordinates& below = drafts_.faces[g].plane;
    const Ends foot{below.lift(below.project(edge[0])), below.lift(below.project(edge[1]))};
    const Vector along = foot[1] - foot[0];
    for (const Ends& stretch : stretches_inside(region(g), foot, drafts_.tolerance)) {
      const auto above = [&](const Point& p) {
        return edge[0] + (dot(p - foot[0], along) / dot(along, along)) * (edge[1] - edge[0]);
      };
      // On the other side of the edge than its face, and seen from the same side.
      add_strip(drafts_.faces[f], {above(stretch[1]), above(stretch[0]), stretch[0], stretch[1]});
    }
  }

  void add_strip(const FaceDraft& standing, const std::array<Point, 4>& corners) {
    FaceDraft strip{.plane = {},
                    .material = standing.material,
                    .back_material = standing.back_material,
                    .part = standing.part,
                    .boundary = {},
                    .lines = {}};
    Vector normal;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      normal = normal + cross(corners[k] - corners[0], corners[(k + 1) % corners.size()] - corners[0]);
    }
    strip.plane = {corners[0], frame_around(normalized(normal))};
    std::array<std::uint32_t, 4> ids{};
    for (std::size_t k = 0; k < corners.size(); ++k) ids.at(k) = drafts_.vertices.add(corners[k]);
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const std::uint32_t next = ids[(k + 1) % ids.size()];
      if (ids[k] != next) strip.boundary.push_back({ids[k], next});
    }
    if (strip.boundary.size() >= 3) strips_.push_back(std::move(strip));
  }

  FaceDrafts& drafts_;
  const NearContactOptions& options_;
  std::size_t count_;
  std::vector<std::optional<PlanarRegion>> regions_;
  BoxTree tree_;
  std::vector<FaceDraft> strips_;
};

}  // namespace

std::size_t close_near_contacts(FaceDrafts& drafts, const NearContactOptions& options) {
  return options.gap_m > drafts.tolerance ? NearContactSearch(drafts, options).run() : 0;
}

}  // namespace clerestory::mesh
