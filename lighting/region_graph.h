// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "lighting/grid_site.h"

namespace clerestory::lighting {

/// Near-horizontal: the normal is within 15 degrees of the vertical.
bool near_horizontal(const GridSite& site, std::uint32_t region);

/// The side of a near-horizontal region that looks up.
mesh::Side upper_side(const GridSite& site, std::uint32_t region);

/// Which way the sensors of a region look that stand on the given side: straight up over a near-horizontal one, else along its
/// normal.
mesh::Vector look_of(const GridSite& site, std::uint32_t region, mesh::Side side);

/// Which regions meet along which edges, in whatever faces they lie. Private to the placing of sensors.
class RegionGraph {
 public:
  explicit RegionGraph(const GridSite& site);

  struct Edge {
    std::uint32_t from = 0;  ///< vertices, one number a place; counter-clockwise seen from the front of the face
    std::uint32_t to = 0;
    std::uint32_t region = 0;
  };

  /// Regions with the sides on which sensors stand, joined where they meet and nothing stands between them at the sensors' height.
  struct Joining {
    std::function<bool(std::uint32_t)> may_join;    ///< whether a region that is no seed may be added
    std::function<mesh::Side(std::uint32_t)> side;  ///< of a region that may join
    double height_m = 0.0;
  };
  /// Grows the seeds; each result is one connected surface, sorted, in the order of the seeds. Of regions that lie on each other
  /// (a floor, and the foot of what stands on it) it takes one.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> join(std::span<const std::uint32_t> seeds,
                                                             const Joining& rules) const;

  /// Boundary loops of a connected set of regions, counter-clockwise seen against `look`, holes clockwise.
  /// Corners in line with their neighbours are left out. Local coordinates [m].
  [[nodiscard]] std::vector<std::vector<mesh::Point>> outline(std::span<const std::uint32_t> regions,
                                                              const mesh::Vector& look) const;

 private:
  /// Directed edges, from and to as places.
  using Directed = std::set<std::pair<std::uint32_t, std::uint32_t>>;

  [[nodiscard]] std::vector<std::uint32_t> grow(std::uint32_t seed, const Joining& rules,
                                                std::vector<std::uint8_t>& state) const;
  [[nodiscard]] std::span<const Edge> edges_of(std::uint32_t region) const {
    return std::span(edges_of_region_).subspan(starts_[region], starts_[region + 1] - starts_[region]);
  }
  /// The edge as it runs counter-clockwise about its region, seen against `look`.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> directed(const Edge& edge, const mesh::Vector& look) const;
  [[nodiscard]] bool overlaps(std::uint32_t region, const mesh::Vector& look, const Directed& taken) const;
  [[nodiscard]] std::span<const Edge> edges_between(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool passable(const Edge& edge, const mesh::Vector& look, double height_m) const;
  [[nodiscard]] std::vector<Edge> boundary(std::span<const std::uint32_t> regions, const mesh::Vector& look) const;
  [[nodiscard]] std::vector<std::vector<mesh::Point>> chain(const std::vector<Edge>& edges,
                                                            const mesh::Frame& frame) const;

  const GridSite& site_;
  std::vector<mesh::Point> places_;
  std::vector<Edge> edges_;            // sorted by the two places, whichever comes first
  std::vector<std::uint32_t> starts_;  // region → edges of it
  std::vector<Edge> edges_of_region_;
};

}  // namespace clerestory::lighting
