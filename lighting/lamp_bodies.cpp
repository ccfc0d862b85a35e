// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/lamp_bodies.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace clerestory::lighting {

using mesh::FaceSide;
using mesh::Point;
using mesh::Vector;
using mesh::Visibility;

namespace {

constexpr std::uint32_t kNoBody = std::numeric_limits<std::uint32_t>::max();
/// Fewer facets are lamps by themselves.
constexpr std::size_t kLeastFacets = 16;
/// Bodies of more facets are not asked whether they are convex, by all pairs of them.
constexpr std::size_t kMostConvex = 16384;
/// Of a body's size, what facets may stand out of each other's planes in a convex one.
constexpr double kFlat = 1e-3;
/// Size over distance up to which a facet's middle stands for all of it.
constexpr double kFar = 0.02;

/// Sets of emitters that hang together.
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Emitters in sets whose faces share edges, on one side; in order of the first of each set.
std::vector<std::vector<std::uint32_t>> connected(const Solution& solution, std::span<const Emitter> emitters) {
  const mesh::Faces& faces = solution.scene().faces;
  Joined sets(emitters.size());
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> first_at;
  for (std::uint32_t i = 0; i < emitters.size(); ++i) {
    const FaceSide side = solution.tree().face_side(emitters[i].root);
    for (const auto& loop : faces.faces[side.face.index()].loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint32_t a = loop[k];
        const std::uint32_t b = loop[(k + 1) % loop.size()];
        const auto [known, fresh] =
            first_at.try_emplace({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(side.side)}, i);
        if (!fresh) sets.join(i, known->second);
      }
    }
  }
  std::vector<std::vector<std::uint32_t>> members(emitters.size());
  for (std::uint32_t i = 0; i < emitters.size(); ++i) members[sets.find(i)].push_back(i);
  std::erase_if(members, [](const auto& set) { return set.empty(); });
  return members;
}

std::array<mesh::ShaftEnd, 6> walls_of(const mesh::Box& box) {
  const auto corner = [&](std::size_t i) {
    return Point{(i & 1U) != 0 ? box.high.x : box.low.x, (i & 2U) != 0 ? box.high.y : box.low.y,
                 (i & 4U) != 0 ? box.high.z : box.low.z};
  };
  const auto wall = [&](std::array<std::size_t, 4> c, const Vector& outward) {
    return mesh::ShaftEnd{
        .corners = {corner(c[0]), corner(c[1]), corner(c[2]), corner(c[3])}, .count = 4, .normal = outward};
  };
  return {wall({0, 4, 6, 2}, {-1, 0, 0}), wall({1, 3, 7, 5}, {1, 0, 0}),  wall({0, 1, 5, 4}, {0, -1, 0}),
          wall({2, 6, 7, 3}, {0, 1, 0}),  wall({0, 2, 3, 1}, {0, 0, -1}), wall({4, 5, 7, 6}, {0, 0, 1})};
}

BodyFacet facet_of(const mesh::ElementTree& tree, std::uint32_t number, const Emitter& emitter) {
  const mesh::ElementId root = emitter.root;
  return {number, tree.centroid(root), tree.normal(root), tree.area(root), tree.radius(root)};
}

bool is_convex(const mesh::ElementTree& tree, std::span<const Emitter> emitters, const LampBody& body, double size_m) {
  if (body.facets.size() > kMostConvex) return false;
  std::vector<Point> corners;
  for (const BodyFacet& facet : body.facets) {
    for (const auto& t : tree.triangles(emitters[facet.emitter].root))
      corners.insert(corners.end(), t.begin(), t.end());
  }
  const auto place = [](const Point& p) { return std::array{p.x, p.y, p.z}; };
  std::sort(corners.begin(), corners.end(), [&](const Point& a, const Point& b) { return place(a) < place(b); });
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return std::all_of(body.facets.begin(), body.facets.end(), [&](const BodyFacet& facet) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Point& p) { return dot(p - facet.centre, facet.normal) <= kFlat * size_m; });
  });
}

}  // namespace

LampBodies::LampBodies(const Solution& solution, std::span<const Emitter> emitters)
    : body_of_face_(solution.scene().faces.count(), kNoBody) {
  const mesh::ElementTree& tree = solution.tree();
  std::vector<mesh::Box> boxes;
  for (const std::vector<std::uint32_t>& set : connected(solution, emitters)) {
    if (set.size() < kLeastFacets) {
      others_.insert(others_.end(), set.begin(), set.end());
      continue;
    }
    const auto number = static_cast<std::uint32_t>(bodies_.size());
    LampBody& body = bodies_.emplace_back();
    body.number = number;
    mesh::Box& box = boxes.emplace_back();
    for (const std::uint32_t i : set) {
      body.facets.push_back(facet_of(tree, i, emitters[i]));
      body_of_face_[tree.face_side(emitters[i].root).face.index()] = number;
      for (const auto& t : tree.triangles(emitters[i].root)) {
        for (const Point& p : t) box.add(p);
      }
    }
    body.walls = walls_of(box);
  }
  std::sort(others_.begin(), others_.end());
  for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
    bodies_[b].convex = is_convex(tree, emitters, bodies_[b], boxes[b].diagonal()) &&
                        solution.scene().shafts->is_clear(boxes[b], body_of_face_, b);
  }
}

BodySight LampBodies::sight(const Solution& solution, const LampBody& body, const mesh::ShaftEnd& from) const {
  const mesh::Shafts& shafts = *solution.scene().shafts;
  bool clear = body.convex;
  bool hidden = true;
  bool outside = false;
  for (const mesh::ShaftEnd& wall : body.walls) {
    const bool faces = std::any_of(from.corners.begin(), from.corners.begin() + static_cast<std::ptrdiff_t>(from.count),
                                   [&](const Point& p) { return dot(p - wall.corners[0], wall.normal) > 0.0; });
    if (!faces) continue;
    outside = true;
    clear = clear && shafts.is_clear(from, wall, body_of_face_, body.number);
    hidden = hidden && !clear && shafts.classify(from, wall) == Visibility::kHidden;
    if (!clear && !hidden) return BodySight::kPartial;
  }
  if (!outside) return BodySight::kPartial;
  return clear ? BodySight::kClear : BodySight::kHidden;
}

double full_factor(const Solution& solution, std::span<const Emitter> emitters, const BodyFacet& facet, const Point& at,
                   const Receiver& receiver) {
  const Vector to = facet.centre - at;
  const double away = -dot(to, facet.normal);
  if (away <= 0.0) return 0.0;
  const double squared = dot(to, to);
  if (facet.radius_m * facet.radius_m > kFar * kFar * squared)
    return full_factor(solution, emitters[facet.emitter], at, receiver);
  return std::max(0.0, receiver.kernel(to)) * away * facet.area_m2 / (std::numbers::pi * squared * squared);
}

}  // namespace clerestory::lighting
