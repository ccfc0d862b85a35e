// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/slits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "mesh/box_tree.h"
#include "mesh/planar_region.h"

namespace clerestory::mesh {

namespace {

/// Wider slits are openings: light spreads below them over more than the elements' size [m].
constexpr double kWidest = 0.1;
/// What is narrower is a contact, or a gap that clean-up was told to leave: rays do not pass it, but for chance [m].
constexpr double kNarrowest = 1e-4;
/// Length of a slit and height of what stands over it, at least, in terms of its width: shorter edges are legs, lower ones mouldings.
constexpr double kLong = 10.0;
constexpr double kTolerance = 2e-5;  ///< of the plane of a face [m]
constexpr double kBeside = 1e-4;     ///< so far from a foot along a face's boundary, its inside is looked for [m]

class SlitSearch {
 public:
  SlitSearch(const Faces& faces, std::span<const std::uint8_t> has_side)
      : faces_(faces), has_side_(has_side), regions_(faces.count()) {
    std::vector<Box> boxes(faces.count());
    for (std::size_t f = 0; f < faces.count(); ++f) {
      for_each_corner(f, [&](const Point& p) { boxes[f].add(p); });
      boxes[f] = grown(boxes[f], kWidest);
    }
    tree_ = BoxTree(boxes);
  }

  std::vector<Slit> run() {
    for (std::size_t g = 0; g < faces_.count(); ++g) {
      for (const std::vector<std::uint32_t>& loop : faces_.faces[g].loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
          look_below(g, {at(loop[i]), at(loop[(i + 1) % loop.size()])});
        }
      }
    }
    return std::move(slits_);
  }

 private:
  [[nodiscard]] const Point& at(std::uint32_t vertex) const { return faces_.shape.vertices[vertex]; }

  template <class Visit>
  void for_each_corner(std::size_t f, const Visit& visit) const {
    for (const std::vector<std::uint32_t>& loop : faces_.faces[f].loops) {
      for (const std::uint32_t vertex : loop) visit(at(vertex));
    }
  }

  [[nodiscard]] PlaneCoordinates plane(std::size_t f) const { return {faces_.faces[f].origin, faces_.faces[f].frame}; }

  const PlanarRegion& region(std::size_t f) {
    if (!regions_[f]) {
      std::vector<Ends> edges;
      for (const std::vector<std::uint32_t>& loop : faces_.faces[f].loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) edges.push_back({at(loop[i]), at(loop[(i + 1) % loop.size()])});
      }
      regions_[f].emplace(plane(f), std::move(edges));
    }
    return *regions_[f];
  }

  /// Finds the faces that an edge of face g passes close before.
  void look_below(std::size_t g, const Ends& edge) {
    if (norm(edge[1] - edge[0]) < kLong * kNarrowest) return;
    Box box;
    for (const Point& end : edge) box.add(end);
    std::vector<std::uint32_t> others;
    tree_.visit([&](const Box& other) { return overlap(box, other); },
                [&](std::uint32_t f) {
                  if (f != g && is_slit(edge, g, f)) others.push_back(f);
                });
    for (const std::uint32_t f : others) add_foot(edge, f);
  }

  [[nodiscard]] bool is_slit(const Ends& edge, std::size_t g, std::size_t f) const {
    const PlaneCoordinates below = plane(f);
    const double first = below.distance(edge[0]);
    const double second = below.distance(edge[1]);
    if (first * second <= 0.0) return false;
    const double width = std::max(std::abs(first), std::abs(second));
    if (std::min(std::abs(first), std::abs(second)) < kNarrowest || width > kWidest) return false;
    if (norm(edge[1] - edge[0]) < kLong * width) return false;
    const Side side = first > 0.0 ? Side::kFront : Side::kBack;
    if (has_side_[FaceSide{FaceId(f), side}.index()] == 0) return false;
    double height = 0.0;
    for_each_corner(g, [&](const Point& p) {
      height = std::max(height, side == Side::kFront ? below.distance(p) : -below.distance(p));
    });
    return height >= kLong * width;
  }

  /// What of a foot lies inside a face, or along its boundary, as where two floors meet below a door.
  std::vector<Ends> stretches_of(const Ends& foot, std::size_t f) {
    std::vector<Ends> stretches = stretches_inside(region(f), foot, kTolerance);
    const Vector aside = kBeside * normalized(cross(plane(f).frame.w, foot[1] - foot[0]));
    for (const Vector& by : {aside, -aside}) {
      if (!stretches.empty()) break;
      stretches = stretches_inside(region(f), {foot[0] + by, foot[1] + by}, kTolerance);
      for (Ends& ends : stretches) ends = {ends[0] - by, ends[1] - by};
    }
    return stretches;
  }

  void add_foot(const Ends& edge, std::uint32_t f) {
    const PlaneCoordinates below = plane(f);
    const Ends foot{below.lift(below.project(edge[0])), below.lift(below.project(edge[1]))};
    const std::array<double, 2> heights{below.distance(edge[0]), below.distance(edge[1])};
    const Side side = heights[0] > 0.0 ? Side::kFront : Side::kBack;
    const double width = std::max(std::abs(heights[0]), std::abs(heights[1]));
    for (const Ends& ends : stretches_of(foot, f)) slits_.push_back({{FaceId(f), ends}, side, width});
  }

  const Faces& faces_;
  std::span<const std::uint8_t> has_side_;
  std::vector<std::optional<PlanarRegion>> regions_;
  BoxTree tree_;
  std::vector<Slit> slits_;
};

}  // namespace

std::vector<Slit> find_slits(const Faces& faces, std::span<const std::uint8_t> has_side) {
  return SlitSearch(faces, has_side).run();
}

std::vector<FaceLine> feet_of(std::span<const Slit> slits) {
  std::vector<FaceLine> lines;
  lines.reserve(slits.size());
  for (const Slit& slit : slits) lines.push_back(slit.foot);
  return lines;
}

}  // namespace clerestory::mesh
