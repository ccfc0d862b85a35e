// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/polygon_pairs.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mesh/box_tree.h"
#include "mesh/phase_part.h"

namespace clerestory::mesh {

namespace {

/// Sides of a polygon up to which separating lines are looked for one by one.
constexpr std::size_t kFewSides = 12;

/// From the least to the greatest of some numbers.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  [[nodiscard]] double reach() const { return std::max(std::abs(low), std::abs(high)); }
};

double length(const Ends& s) { return norm(s[1] - s[0]); }

Ends longest_of(const std::vector<Ends>& segments) {
  return *std::max_element(segments.begin(), segments.end(),
                           [](const Ends& a, const Ends& b) { return length(a) < length(b); });
}

class PairSearch {
 public:
  PairSearch(const Soup& soup, double tolerance) : soup_(soup), slack_(kMeetingOverTolerance * tolerance) {
    planes_.reserve(soup.polygons.size());
    boxes_.resize(soup.polygons.size());
    areas_.reserve(soup.polygons.size());
    for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
      planes_.push_back(plane_of(soup.points, soup.polygons[p], 0.0));
      areas_.push_back(area(soup.points, soup.polygons[p]));
      if (planes_[p]) {
        for_each_edge(soup.polygons[p], [&](std::uint32_t a, std::uint32_t) { boxes_[p].add(soup.points[a]); });
      }
    }
    tree_ = BoxTree(boxes_);
  }

  std::vector<PolygonPair> run(PhasePart& progress) {
    for (std::uint32_t f = 0; f < soup_.polygons.size(); ++f) {
      progress.advance(f, soup_.polygons.size());
      if (soup_.polygons[f].checked || !planes_[f]) continue;
      look_at_itself(f);
      const PlaneCoordinates plane{planes_[f]->origin, {{}, {}, planes_[f]->normal}};
      near_.clear();
      // Of polygons that lie in one plane but for rounding, boxes may miss each other by that.
      const Box around = grown(boxes_[f], slack_);
      tree_.visit([&](const Box& box) { return overlap(around, box) && near_plane(box, plane, slack_); },
                  [&](std::uint32_t g) {
                    if (g > f || soup_.polygons[g].checked) near_.push_back(g);
                  });
      for (const std::uint32_t g : near_) {
        if (g != f) look_at(std::min(f, g), std::max(f, g));
      }
    }
    std::sort(pairs_.begin(), pairs_.end(), [](const PolygonPair& a, const PolygonPair& b) {
      return std::pair(a.first, a.second) < std::pair(b.first, b.second);
    });
    return std::move(pairs_);
  }

 private:
  /// Distances of the corners of one polygon from the plane of another.
  Range distances(std::uint32_t polygon, std::uint32_t plane) const {
    Range range;
    for_each_edge(soup_.polygons[polygon],
                  [&](std::uint32_t a, std::uint32_t) { range.add(planes_[plane]->distance(soup_.points[a])); });
    return range;
  }

  void look_at(std::uint32_t f, std::uint32_t g) {
    // The larger one knows its plane better. It may have very many corners, of all that touches it: they are not gone through for each.
    const bool f_is_larger = areas_[f] >= areas_[g];
    const std::uint32_t larger = f_is_larger ? f : g;
    const std::uint32_t smaller = f_is_larger ? g : f;
    const Range of_smaller = distances(smaller, larger);
    if (of_smaller.reach() <= slack_) {
      look_for_overlap(f, g);
      return;
    }
    const auto straddles = [&](const Range& r) { return r.low < -slack_ && r.high > slack_; };
    if (straddles(of_smaller) && straddles(distances(larger, smaller)) && hulls_cross(f, g)) look_for_crossing(f, g);
  }

  /// Whether on the line where the planes meet the stretch within the convex hull of one polygon overlaps that of the other.
  bool hulls_cross(std::uint32_t f, std::uint32_t g) const {
    const Vector direction = normalized(cross(planes_[f]->normal, planes_[g]->normal));
    const auto stretch = [&](std::uint32_t polygon, std::uint32_t plane) {
      Range range;
      for_each_edge(soup_.polygons[polygon], [&](std::uint32_t a, std::uint32_t b) {
        const double da = planes_[plane]->distance(soup_.points[a]);
        const double db = planes_[plane]->distance(soup_.points[b]);
        if ((da > 0.0) == (db > 0.0)) return;
        const Vector at = soup_.points[a] - planes_[f]->origin;
        range.add(dot(at + (da / (da - db)) * (soup_.points[b] - soup_.points[a]), direction));
      });
      return range;
    };
    const Range in_f = stretch(f, g);
    const Range in_g = stretch(g, f);
    return std::min(in_f.high, in_g.high) - std::max(in_f.low, in_g.low) > slack_;
  }

  void look_for_crossing(std::uint32_t f, std::uint32_t g) {
    const auto stretches = crossing_stretches(region(f), region(g), slack_);
    if (!stretches.empty()) pairs_.push_back({PolygonPair::Kind::kCrossing, f, g, longest_of(stretches)});
  }

  void look_for_overlap(std::uint32_t f, std::uint32_t g) {
    const Vector& normal = planes_[areas_[f] >= areas_[g] ? f : g]->normal;
    if (is_parted(f, g, normal) || is_parted(g, f, normal)) return;
    const PlanarRegion of_f = region(f);
    const PlanarRegion of_g = region(g);
    std::vector<Ends> inside;
    const auto collect = [&](const PlanarRegion& outer, const PlanarRegion& inner) {
      for (const Ends& edge : inner.edges) {
        const std::vector<Ends> found = stretches_inside(outer, edge, slack_);
        inside.insert(inside.end(), found.begin(), found.end());
      }
    };
    collect(of_f, of_g);
    collect(of_g, of_f);
    if (!inside.empty()) pairs_.push_back({PolygonPair::Kind::kOverlap, f, g, longest_of(inside)});
  }

  /// Whether a side of f has f on one side of it and g on the other.
  bool is_parted(std::uint32_t f, std::uint32_t g, const Vector& normal) const {
    const SoupPolygon& polygon = soup_.polygons[f];
    if (polygon.loops[0].size() > kFewSides) return false;
    const std::vector<std::uint32_t>& loop = polygon.loops[0];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point& a = soup_.points[loop[i]];
      const Vector across = normalized(cross(normal, soup_.points[loop[(i + 1) % loop.size()]] - a));
      const auto range_of = [&](std::uint32_t p) {
        Range range;
        for (const std::uint32_t corner : soup_.polygons[p].loops[0]) range.add(dot(soup_.points[corner] - a, across));
        return range;
      };
      const Range own = range_of(f);
      const Range other = range_of(g);
      if (other.high <= own.low + slack_ || other.low >= own.high - slack_) return true;
    }
    return false;
  }

  /// Sides of a polygon that cross, by more than the slack on either side.
  void look_at_itself(std::uint32_t f) {
    std::size_t sides = 0;
    for (const std::vector<std::uint32_t>& loop : soup_.polygons[f].loops) sides += loop.size();
    if (sides <= 3) return;
    const PlanarRegion own = region(f);
    std::vector<std::array<Point2, 2>> flat;
    std::vector<Box> boxes(own.edges.size());
    for (std::size_t e = 0; e < own.edges.size(); ++e) {
      flat.push_back({own.plane.project(own.edges[e][0]), own.plane.project(own.edges[e][1])});
      for (const Point2& p : flat[e]) boxes[e].add(Point{p.x, p.y, 0.0});
    }
    const BoxTree tree(boxes);
    for (std::uint32_t e = 0; e < flat.size(); ++e) {
      std::optional<std::uint32_t> found;
      tree.visit([&](const Box& box) { return !found && overlap(boxes[e], box); },
                 [&](std::uint32_t other) {
                   if (!found && other > e && cross_each_other(flat[e], flat[other])) found = other;
                 });
      if (!found) continue;
      pairs_.push_back({PolygonPair::Kind::kSelf, f, f, own.edges[e]});
      return;
    }
  }

  [[nodiscard]] bool cross_each_other(const std::array<Point2, 2>& s, const std::array<Point2, 2>& t) const {
    const auto parts = [&](const std::array<Point2, 2>& line, const std::array<Point2, 2>& ends) {
      const double size = std::hypot(line[1].x - line[0].x, line[1].y - line[0].y);
      const double a = doubled_area(line[0], line[1], ends[0]) / size;
      const double b = doubled_area(line[0], line[1], ends[1]) / size;
      return std::min(a, b) < -slack_ && std::max(a, b) > slack_;
    };
    return parts(s, t) && parts(t, s);
  }

  PlanarRegion region(std::uint32_t p) const { return region_of(soup_, soup_.polygons[p]); }

  const Soup& soup_;
  double slack_;
  std::vector<std::optional<Plane>> planes_;
  std::vector<double> areas_;
  std::vector<Box> boxes_;
  BoxTree tree_;
  std::vector<std::uint32_t> near_;
  std::vector<PolygonPair> pairs_;
};

}  // namespace

PlanarRegion region_of(const Soup& soup, const SoupPolygon& polygon) {
  const std::optional<Plane> plane = plane_of(soup.points, polygon, 0.0);
  assert(plane);
  std::vector<Ends> edges;
  for_each_edge(polygon, [&](std::uint32_t a, std::uint32_t b) { edges.push_back({soup.points[a], soup.points[b]}); });
  return {{plane->origin, frame_around(plane->normal)}, std::move(edges)};
}

std::vector<PolygonPair> find_polygon_pairs(const Soup& soup, double tolerance, Progress* progress) {
  NoProgress unwatched;
  PhasePart part(progress != nullptr ? *progress : unwatched, 0.0, 1.0);
  return PairSearch(soup, tolerance).run(part);
}

}  // namespace clerestory::mesh
