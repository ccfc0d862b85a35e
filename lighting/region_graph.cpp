// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/region_graph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "mesh/straight_corners.h"

namespace clerestory::lighting {

namespace {

using mesh::Point;
using mesh::Vector;
using Edge = RegionGraph::Edge;

constexpr double kLevelCosine = 0.966;  // 15 degrees
/// Surfaces whose looks differ by more than this do not lie in one plane (about 0.1 degrees).
constexpr double kSameLook = 1.0 - 1.5e-6;
/// How far on either side of an edge a passage over it is tried [m]; more than the thickness of any sheet that stands on it.
constexpr double kStep = 0.02;
/// Passages are tried this far apart along an edge [m] …
constexpr double kTrySpacing = 0.5;
/// … and this far above a surface at least, where the sensors lie on it [m].
constexpr double kLeastHeight = 0.01;

/// What is known of a region while surfaces grow.
enum State : std::uint8_t { kUnknown, kMayJoin, kRefused, kTaken };

std::pair<std::uint32_t, std::uint32_t> key(const Edge& e) { return std::minmax(e.from, e.to); }

/// Numbers places: vertices at exactly the same point are one.
std::vector<std::uint32_t> number_places(const std::vector<Point>& vertices, std::vector<Point>& places) {
  std::vector<std::uint32_t> order(vertices.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto as_tuple = [&](std::uint32_t i) { return std::tuple(vertices[i].x, vertices[i].y, vertices[i].z); };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return as_tuple(a) < as_tuple(b); });
  std::vector<std::uint32_t> place_of(vertices.size());
  for (const std::uint32_t i : order) {
    if (places.empty() || !(places.back() == vertices[i])) places.push_back(vertices[i]);
    place_of[i] = static_cast<std::uint32_t>(places.size() - 1);
  }
  return place_of;
}

}  // namespace

bool near_horizontal(const GridSite& site, std::uint32_t region) {
  return std::abs(site.faces.faces[site.regions.face[region].index()].frame.w.z) > kLevelCosine;
}

mesh::Side upper_side(const GridSite& site, std::uint32_t region) {
  return site.faces.faces[site.regions.face[region].index()].frame.w.z > 0.0 ? mesh::Side::kFront : mesh::Side::kBack;
}

Vector look_of(const GridSite& site, std::uint32_t region, mesh::Side side) {
  if (near_horizontal(site, region)) return {0.0, 0.0, 1.0};
  return mesh::side_normal(site.faces, site.regions.face[region], side);
}

RegionGraph::RegionGraph(const GridSite& site) : site_(site) {
  const auto place_of = number_places(site.faces.shape.vertices, places_);
  const auto& triangles = site.faces.shape.triangles;
  const auto edge_of = [&](std::uint32_t t, std::size_t k) {
    return std::pair(place_of[triangles[t].vertices[k]], place_of[triangles[t].vertices[(k + 1) % 3]]);
  };
  for (std::uint32_t r = 0; r < site.regions.count(); ++r) {
    starts_.push_back(static_cast<std::uint32_t>(edges_of_region_.size()));
    Directed inner;
    for (const std::uint32_t t : site.regions.of(r)) {
      for (std::size_t k = 0; k < 3; ++k) {
        if ((triangles[t].constrained >> k & 1) == 0) inner.insert(edge_of(t, k));
      }
    }
    for (const std::uint32_t t : site.regions.of(r)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [from, to] = edge_of(t, k);
        // Where nothing but the rooms divides a face, the edge is constrained for none of the two.
        const bool border = (triangles[t].constrained >> k & 1) != 0 || !inner.contains({to, from});
        if (border) edges_of_region_.push_back({from, to, r});
      }
    }
  }
  starts_.push_back(static_cast<std::uint32_t>(edges_of_region_.size()));
  edges_ = edges_of_region_;
  std::stable_sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return key(a) < key(b); });
}

std::span<const Edge> RegionGraph::edges_between(std::uint32_t a, std::uint32_t b) const {
  const auto [first, last] = std::equal_range(edges_.begin(), edges_.end(), Edge{a, b, 0},
                                              [](const Edge& x, const Edge& y) { return key(x) < key(y); });
  return {first, last};
}

bool RegionGraph::passable(const Edge& edge, const Vector& look, double height_m) const {
  const Vector along = places_[edge.to] - places_[edge.from];
  const double length = mesh::norm(along);
  const Vector step = kStep * mesh::normalized(mesh::cross(look, along));
  const int tries = std::clamp(static_cast<int>(std::ceil(length / kTrySpacing)), 3, 16);
  int clear = 0;
  for (int i = 0; i < tries; ++i) {
    const Point p = places_[edge.from] + ((i + 0.5) / tries) * along + std::max(height_m, kLeastHeight) * look;
    if (site_.clear(p - step, p + step)) ++clear;
  }
  return 2 * clear >= tries;
}

std::pair<std::uint32_t, std::uint32_t> RegionGraph::directed(const Edge& edge, const Vector& look) const {
  const Vector front = mesh::side_normal(site_.faces, site_.regions.face[edge.region], mesh::Side::kFront);
  return mesh::dot(front, look) < 0.0 ? std::pair(edge.to, edge.from) : std::pair(edge.from, edge.to);
}

bool RegionGraph::overlaps(std::uint32_t region, const Vector& look, const Directed& taken) const {
  return std::ranges::any_of(edges_of(region), [&](const Edge& e) { return taken.contains(directed(e, look)); });
}

std::vector<std::vector<std::uint32_t>> RegionGraph::join(std::span<const std::uint32_t> seeds,
                                                          const Joining& rules) const {
  std::vector<std::uint8_t> state(site_.regions.count(), kUnknown);
  for (const std::uint32_t seed : seeds) state[seed] = kMayJoin;
  std::vector<std::vector<std::uint32_t>> surfaces;
  for (const std::uint32_t seed : seeds) {
    if (state[seed] != kTaken) surfaces.push_back(grow(seed, rules, state));
  }
  return surfaces;
}

std::vector<std::uint32_t> RegionGraph::grow(std::uint32_t seed, const Joining& rules,
                                             std::vector<std::uint8_t>& state) const {
  const Vector look = look_of(site_, seed, rules.side(seed));
  std::vector<std::uint32_t> surface;
  Directed taken;
  const auto take = [&](std::uint32_t region) {
    state[region] = kTaken;
    surface.push_back(region);
    for (const Edge& edge : edges_of(region)) taken.insert(directed(edge, look));
  };
  const auto joins = [&](std::uint32_t region) {
    if (state[region] == kUnknown) state[region] = rules.may_join(region) ? kMayJoin : kRefused;
    return state[region] == kMayJoin && mesh::dot(look, look_of(site_, region, rules.side(region))) > kSameLook &&
           !overlaps(region, look, taken);
  };
  take(seed);
  for (std::size_t next = 0; next < surface.size(); ++next) {
    for (const Edge& edge : edges_of(surface[next])) {
      for (const Edge& other : edges_between(edge.from, edge.to)) {
        if (joins(other.region) && passable(edge, look, rules.height_m)) take(other.region);
      }
    }
  }
  std::sort(surface.begin(), surface.end());
  return surface;
}

std::vector<Edge> RegionGraph::boundary(std::span<const std::uint32_t> regions, const Vector& look) const {
  Directed all;
  for (const std::uint32_t r : regions) {
    for (const Edge& edge : edges_of(r)) all.insert(directed(edge, look));
  }
  std::vector<Edge> left;
  for (const auto& [from, to] : all) {
    if (!all.contains({to, from})) left.push_back({from, to, 0});
  }
  return left;
}

std::vector<std::vector<Point>> RegionGraph::chain(const std::vector<Edge>& edges, const mesh::Frame& frame) const {
  std::multimap<std::uint32_t, std::size_t> leaving;
  for (std::size_t i = 0; i < edges.size(); ++i) leaving.emplace(edges[i].from, i);
  const auto angle = [&](std::uint32_t from, std::uint32_t to) {
    const Vector d = places_[to] - places_[from];
    return std::atan2(mesh::dot(d, frame.v), mesh::dot(d, frame.u));
  };
  // Where loops touch at a corner, the sharpest turn to the left keeps them apart.
  const auto next_edge = [&](const Edge& edge) {
    const double back = angle(edge.to, edge.from);
    auto best = leaving.end();
    double best_turn = 0.0;
    const auto [first, last] = leaving.equal_range(edge.to);
    for (auto it = first; it != last; ++it) {
      double turn = back - angle(edge.to, edges[it->second].to);
      if (turn <= 0.0) turn += 2.0 * std::numbers::pi;
      if (best == leaving.end() || turn < best_turn) {
        best = it;
        best_turn = turn;
      }
    }
    return best;
  };

  std::vector<std::vector<Point>> loops;
  while (!leaving.empty()) {
    std::vector<Point> loop;
    for (auto it = leaving.begin(); it != leaving.end();) {
      const Edge& edge = edges[it->second];
      loop.push_back(places_[edge.from]);
      leaving.erase(it);
      it = next_edge(edge);
    }
    loop = mesh::without_straight_corners(loop);
    if (loop.size() >= 3) loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<std::vector<Point>> RegionGraph::outline(std::span<const std::uint32_t> regions, const Vector& look) const {
  return chain(boundary(regions, look), mesh::frame_around(look));
}

}  // namespace clerestory::lighting
