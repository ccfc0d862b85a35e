// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/coplanar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "mesh/edge_uses.h"

namespace clerestory::mesh {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// All uses of edges, sorted, with where those of each polygon stand.
struct Adjacency {
  std::vector<EdgeUse> uses;
  std::vector<std::vector<std::uint32_t>> of_polygon;

  explicit Adjacency(const Soup& soup) : uses(sorted_edge_uses(soup)), of_polygon(soup.polygons.size()) {
    for (std::uint32_t u = 0; u < uses.size(); ++u) of_polygon[uses[u].polygon].push_back(u);
  }

  /// Calls visit(polygon) for each that walks an edge of this polygon in the other direction.
  template <class Visit>
  void for_each_neighbour(std::uint32_t polygon, const Visit& visit) const {
    for (const std::uint32_t u : of_polygon[polygon]) {
      const EdgeUse& own = uses[u];
      const auto same_edge = [&](std::uint32_t i) { return uses[i].edge == own.edge; };
      std::uint32_t first = u;
      while (first > 0 && same_edge(first - 1)) --first;
      for (std::uint32_t i = first; i < uses.size() && same_edge(i); ++i) {
        if (uses[i].polygon != polygon && uses[i].forward != own.forward) visit(uses[i].polygon);
      }
    }
  }
};

class Grouping {
 public:
  Grouping(const Soup& soup, const CoplanarOptions& options)
      : soup_(soup), options_(options), adjacency_(soup), group_(soup.polygons.size(), kNone) {
    for (const SoupPolygon& polygon : soup.polygons) {
      planes_.push_back(plane_of(soup.points, polygon, 0.0));
      areas_.push_back(area(soup.points, polygon));
    }
  }

  std::vector<CoplanarGroup> run() {
    // Large polygons first: their planes are the best known.
    std::vector<std::uint32_t> seeds(soup_.polygons.size());
    std::iota(seeds.begin(), seeds.end(), 0U);
    std::stable_sort(seeds.begin(), seeds.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return areas_[a] > areas_[b]; });
    std::vector<CoplanarGroup> groups;
    for (const std::uint32_t seed : seeds) {
      if (group_[seed] == kNone && planes_[seed])
        groups.push_back(grow(seed, static_cast<std::uint32_t>(groups.size())));
    }
    std::sort(groups.begin(), groups.end(),
              [](const CoplanarGroup& a, const CoplanarGroup& b) { return a.polygons < b.polygons; });
    return groups;
  }

 private:
  CoplanarGroup grow(std::uint32_t seed, std::uint32_t index) {
    CoplanarGroup group{{seed}, *planes_[seed]};
    group_[seed] = index;
    for (std::size_t i = 0; i < group.polygons.size(); ++i) {
      adjacency_.for_each_neighbour(group.polygons[i], [&](std::uint32_t next) {
        if (group_[next] != kNone || !belongs(next, seed)) return;
        group_[next] = index;
        if (lies_on_group(next, index)) {
          group_[next] = kNone;
          return;
        }
        group.polygons.push_back(next);
      });
    }
    std::sort(group.polygons.begin(), group.polygons.end());
    return group;
  }

  bool belongs(std::uint32_t polygon, std::uint32_t seed) const {
    const SoupPolygon& p = soup_.polygons[polygon];
    const SoupPolygon& s = soup_.polygons[seed];
    if (!planes_[polygon] || p.material != s.material || p.back_material != s.back_material) return false;
    if (options_.same_part && p.part != s.part) return false;
    const Plane& plane = *planes_[seed];
    double perimeter = 0.0;
    bool near = true;
    for_each_edge(p, [&](std::uint32_t a, std::uint32_t b) {
      near = near && std::abs(plane.distance(soup_.points[a])) <= options_.plane_tolerance;
      perimeter += norm(soup_.points[b] - soup_.points[a]);
    });
    if (!near) return false;
    const double cosine = dot(planes_[polygon]->normal, plane.normal);
    const double sine = norm(cross(planes_[polygon]->normal, plane.normal));
    const double width = 2.0 * areas_[polygon] / std::max(perimeter, std::numeric_limits<double>::min());
    return cosine > 0.0 && sine <= options_.angle_tolerance + options_.plane_tolerance / width;
  }

  /// Whether the polygon walks an edge in the same direction as one of the group: they lie on each other there.
  bool lies_on_group(std::uint32_t polygon, std::uint32_t index) const {
    for (const std::uint32_t u : adjacency_.of_polygon[polygon]) {
      const EdgeUse& own = adjacency_.uses[u];
      const auto rival = [&](std::uint32_t i) {
        const EdgeUse& use = adjacency_.uses[i];
        return use.polygon != polygon && use.forward == own.forward && group_[use.polygon] == index;
      };
      for (std::uint32_t i = u; i-- > 0 && adjacency_.uses[i].edge == own.edge;) {
        if (rival(i)) return true;
      }
      for (std::uint32_t i = u + 1; i < adjacency_.uses.size() && adjacency_.uses[i].edge == own.edge; ++i) {
        if (rival(i)) return true;
      }
    }
    return false;
  }

  const Soup& soup_;
  const CoplanarOptions& options_;
  Adjacency adjacency_;
  std::vector<std::uint32_t> group_;
  std::vector<std::optional<Plane>> planes_;
  std::vector<double> areas_;
};

}  // namespace

std::vector<CoplanarGroup> group_coplanar(const Soup& soup, const CoplanarOptions& options) {
  return Grouping(soup, options).run();
}

}  // namespace clerestory::mesh
