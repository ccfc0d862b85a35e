// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "mesh/edge_uses.h"
#include "mesh/polygon_pairs.h"

namespace clerestory::mesh {

namespace {

/// No gap is wider than this, but for rounding, unless the user says so [m].
constexpr double kMaxGap = 1e-3;
/// What a corner may move by beyond the precision, as a share of the shortest side at it: fine meshes keep their shape.
constexpr double kMoveOverSide = 0.002;
/// Share of a step of the coordinates, between √3/2 and 1.
constexpr double kGapOverStep = 0.9;
/// Coordinates that are multiples of a step within this share of it were rounded to it.
constexpr double kRoundedShare = 1e-3;
/// Share of coordinates that must be multiples: the others come from transforms.
constexpr double kRoundedCoordinates = 0.99;
/// Half of a unit in the last place of single precision, twice over.
constexpr double kSinglePrecision = 1.2e-7;
/// A polygon lies before another when it is parallel to it within 25 degrees …
const double kParallelCosine = std::cos(25.0 * std::numbers::pi / 180.0);
/// … and the way to it is along its normal within 45 degrees.
const double kAcrossCosine = std::sqrt(0.5);

bool are_multiples(const Soup& soup, double step) {
  std::size_t multiples = 0;
  for (const Point& p : soup.points) {
    for (const double x : {p.x, p.y, p.z}) {
      if (std::abs(x / step - std::round(x / step)) <= kRoundedShare) ++multiples;
    }
  }
  return static_cast<double>(multiples) >= kRoundedCoordinates * 3.0 * static_cast<double>(soup.points.size());
}

/// Where a corner goes, and to what.
struct Move {
  std::uint32_t vertex = 0;
  Point to;
  double distance = 0.0;
};

class GapSearch {
 public:
  GapSearch(const Soup& soup, const GapWidth& gap, double tolerance)
      : soup_(soup),
        gap_(gap),
        tolerance_(tolerance),
        polygons_of_(soup.points.size()),
        shortest_side_(soup.points.size(), std::numeric_limits<double>::infinity()) {
    const std::vector<EdgeUse> uses = sorted_edge_uses(soup);
    for_each_edge_group(uses, [&](std::size_t first, std::size_t last) {
      if (last - first == 1) corners_.insert(corners_.end(), uses[first].edge.begin(), uses[first].edge.end());
    });
    std::sort(corners_.begin(), corners_.end());
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    if (corners_.empty()) return;
    std::vector<Box> boxes(soup.polygons.size());
    for (std::uint32_t p = 0; p < soup.polygons.size(); ++p) {
      for_each_edge(soup.polygons[p], [&](std::uint32_t a, std::uint32_t) { boxes[p].add(soup.points[a]); });
      planes_.push_back(plane_of(soup.points, soup.polygons[p], 0.0));
    }
    tree_ = BoxTree(boxes);
    std::vector<bool> is_corner(soup.points.size(), false);
    for (const std::uint32_t corner : corners_) is_corner[corner] = true;
    for (std::uint32_t p = 0; p < soup.polygons.size(); ++p) {
      for_each_edge(soup.polygons[p], [&](std::uint32_t a, std::uint32_t b) {
        if (is_corner[a]) polygons_of_[a].push_back(p);
        const double length = norm(soup.points[b] - soup.points[a]);
        for (const std::uint32_t end : {a, b}) shortest_side_[end] = std::min(shortest_side_[end], length);
      });
    }
  }

  /// A corner that others are drawn to stays, so that none is drawn along a chain.
  std::vector<Move> run() const {
    std::vector<Move> moves;
    std::set<std::uint32_t> targets;
    std::set<std::uint32_t> moved;
    for (const std::uint32_t corner : corners_) {
      if (targets.contains(corner)) continue;
      const std::optional<Target> target = nearest(corner, moved);
      if (!target) continue;
      targets.insert(target->vertices.begin(), target->vertices.end());
      moved.insert(corner);
      moves.push_back({corner, target->at, target->distance});
    }
    return moves;
  }

  [[nodiscard]] const std::vector<std::uint32_t>& polygons_of(std::uint32_t vertex) const {
    return polygons_of_[vertex];
  }

 private:
  struct Target {
    Point at;
    double distance = 0.0;
    int rank = 0;                         ///< 0 a vertex, 1 an edge, 2 the inside of a polygon: the lower first
    std::vector<std::uint32_t> vertices;  ///< that must stay for it
  };

  std::optional<Target> nearest(std::uint32_t corner, const std::set<std::uint32_t>& moved) const {
    std::optional<Target> best;
    const double reach = std::min(gap_.wide_m, std::max(gap_.any_m, kMoveOverSide * shortest_side_[corner]));
    Box near;
    near.add(soup_.points[corner]);
    near = grown(near, reach);
    tree_.visit([&](const Box& box) { return overlap(near, box); },
                [&](std::uint32_t p) {
                  const std::vector<std::uint32_t>& own = polygons_of_[corner];
                  if (!planes_[p] || std::find(own.begin(), own.end(), p) != own.end()) return;
                  std::optional<Target> found = target_on(corner, p, reach);
                  if (!found || found->distance <= tolerance_ || lies_before(corner, p, found->at)) return;
                  const auto was_moved = [&](std::uint32_t v) { return moved.contains(v); };
                  if (std::any_of(found->vertices.begin(), found->vertices.end(), was_moved)) return;
                  const auto key = [](const Target& t) { return std::pair(t.rank, t.distance); };
                  if (!best || key(*found) < key(*best)) best = std::move(found);
                });
    return best;
  }

  /// The nearest place of a polygon within the gap: a vertex rather than an edge, an edge rather than its inside.
  std::optional<Target> target_on(std::uint32_t corner, std::uint32_t p, double reach) const {
    const Point& at = soup_.points[corner];
    std::optional<Target> best;
    bool touches = false;
    const auto offer = [&](const Point& place, int rank, std::vector<std::uint32_t> vertices) {
      const double distance = norm(place - at);
      touches = touches || distance <= tolerance_;
      if (distance > reach) return;
      if (best && std::pair(best->rank, best->distance) <= std::pair(rank, distance)) return;
      best = Target{place, distance, rank, std::move(vertices)};
    };
    for_each_edge(soup_.polygons[p], [&](std::uint32_t a, std::uint32_t b) {
      offer(soup_.points[a], 0, {a});
      const Vector d = soup_.points[b] - soup_.points[a];
      const double t = dot(at - soup_.points[a], d) / dot(d, d);
      if (t > 0.0 && t < 1.0) offer(soup_.points[a] + t * d, 1, {a, b});
    });
    const double height = planes_[p]->distance(at);
    if (!best && std::abs(height) <= reach) {
      const PlanarRegion region = region_of(soup_, soup_.polygons[p]);
      if (region.outline.winding(region.plane.project(at)) != 0) {
        offer(at - height * planes_[p]->normal, 2, soup_.polygons[p].loops[0]);
      }
    }
    // A corner that touches the polygon has no gap to it.
    return touches ? std::nullopt : best;
  }

  /// Whether a polygon of the corner is parallel to the other, and drawn to it across both and not beside it.
  bool lies_before(std::uint32_t corner, std::uint32_t other, const Point& target) const {
    const Vector way = normalized(target - soup_.points[corner]);
    return std::any_of(polygons_of_[corner].begin(), polygons_of_[corner].end(), [&](std::uint32_t p) {
      if (!planes_[p]) return true;
      const Vector& normal = planes_[p]->normal;
      return std::abs(dot(normal, planes_[other]->normal)) > kParallelCosine &&
             std::abs(dot(way, normal)) > kAcrossCosine;
    });
  }

  const Soup& soup_;
  GapWidth gap_;
  double tolerance_;
  std::vector<std::optional<Plane>> planes_;
  BoxTree tree_;
  std::vector<std::uint32_t> corners_;  ///< vertices of open edges, ascending
  std::vector<std::vector<std::uint32_t>> polygons_of_;
  std::vector<double> shortest_side_;  ///< [vertices] of those that meet there [m]
};

}  // namespace

double gap_of_precision(const Soup& soup, double tolerance) {
  double largest = 0.0;
  for (const Point& p : soup.points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  double gap = std::max(tolerance, kSinglePrecision * largest);
  for (double step = kMaxGap; step * kGapOverStep > tolerance; step /= 10.0) {
    if (!are_multiples(soup, step)) continue;
    gap = std::max(gap, kGapOverStep * step);
    break;
  }
  return std::min(gap, kMaxGap);
}

GapWidth gap_unasked(const Soup& soup, double tolerance) {
  return {gap_of_precision(soup, tolerance), kMaxGap + tolerance};
}

namespace {

/// Polygons that the moves would turn over or rob of half of their area.
std::set<std::uint32_t> spoiled(const Soup& soup, const std::vector<Point>& moved_points, const GapSearch& search,
                                const std::vector<Move>& moves) {
  std::set<std::uint32_t> bad;
  for (const Move& move : moves) {
    for (const std::uint32_t p : search.polygons_of(move.vertex)) {
      Vector before;
      Vector after;
      for (const std::vector<std::uint32_t>& loop : soup.polygons[p].loops) {
        before = before + newell(soup.points, loop);
        after = after + newell(moved_points, loop);
      }
      if (dot(after, before) < 0.5 * dot(before, before)) bad.insert(p);
    }
  }
  return bad;
}

}  // namespace

bool close_gaps(Soup& soup, const GapWidth& gap, double tolerance, DefectList& defects) {
  if (gap.wide_m <= tolerance) return false;
  const GapSearch search(soup, gap, tolerance);
  const std::vector<Move> moves = search.run();
  if (moves.empty()) return false;
  std::vector<Point> points = soup.points;
  for (const Move& move : moves) points[move.vertex] = move.to;
  const std::set<std::uint32_t> bad = spoiled(soup, points, search, moves);
  bool changed = false;
  for (const Move& move : moves) {
    const std::vector<std::uint32_t>& own = search.polygons_of(move.vertex);
    const DefectPlace place{soup.polygons[own[0]].source, soup.points[move.vertex], move.distance};
    if (std::any_of(own.begin(), own.end(), [&](std::uint32_t p) { return bad.contains(p); })) {
      defects.leave("gaps", place, "closing it would turn a polygon over or take half of its area");
      continue;
    }
    defects.add("gaps", place);
    soup.points[move.vertex] = move.to;
    changed = true;
  }
  return changed;
}

}  // namespace clerestory::mesh
