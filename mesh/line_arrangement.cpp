// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/line_arrangement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace clerestory::mesh {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// A line runs along a segment where it is near it for this many distances: at angles below 12 degrees. Else it crosses or meets it.
constexpr double kAlong = 6.0;
/// A line runs along a segment within this share of the distance, so that where it leaves it its end goes to it for sure.
constexpr double kAlongShare = 0.6;
/// Pieces shorter than this many distances are left out: their ends would fall together.
constexpr double kShortest = 2.0;

double length(const Point2& a, const Point2& b) { return std::hypot(b.x - a.x, b.y - a.y); }

Point2 between(const Point2& a, const Point2& b, double t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

/// Where along the segment from a to b [0, 1] the nearest point to p is.
double nearest_on(const Point2& a, const Point2& b, const Point2& p) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  return squared > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
}

/// The stretch of a line inside a disc.
std::optional<Stretch> inside_disc(const Point2& a, const Point2& b, const Point2& centre, double radius) {
  const double l = length(a, b);
  const double along = ((centre.x - a.x) * (b.x - a.x) + (centre.y - a.y) * (b.y - a.y)) / (l * l);
  const double away = length(between(a, b, along), centre);
  if (away >= radius) return std::nullopt;
  const double half = std::sqrt(radius * radius - away * away) / l;
  return Stretch{along - half, along + half};
}

/// Keeps where a value, linear along a line, is at most a limit.
void keep_below(double at_begin, double at_end, double limit, Stretch& kept) {
  const double slope = at_end - at_begin;
  if (slope == 0.0) {
    if (at_begin > limit) kept.end = kept.begin;
    return;
  }
  const double t = (limit - at_begin) / slope;
  if (slope > 0.0) {
    kept.end = std::min(kept.end, t);
  } else {
    kept.begin = std::max(kept.begin, t);
  }
}

/// The stretch of a line within a distance of a segment from c to d: that set is convex.
std::optional<Stretch> near_segment(const Point2& a, const Point2& b, const Point2& c, const Point2& d,
                                    double distance) {
  std::optional<Stretch> found = inside_disc(a, b, c, distance);
  const auto join = [&](const Stretch& s) {
    found = found ? Stretch{std::min(found->begin, s.begin), std::max(found->end, s.end)} : s;
  };
  if (const auto at_end = inside_disc(a, b, d, distance)) join(*at_end);
  const double l = length(c, d);
  if (l == 0.0) return found;
  const auto along = [&](const Point2& p) { return ((p.x - c.x) * (d.x - c.x) + (p.y - c.y) * (d.y - c.y)) / l; };
  const auto across = [&](const Point2& p) { return ((p.y - c.y) * (d.x - c.x) - (p.x - c.x) * (d.y - c.y)) / l; };
  Stretch strip{-1e300, 1e300};
  keep_below(along(a), along(b), l, strip);
  keep_below(-along(a), -along(b), 0.0, strip);
  keep_below(across(a), across(b), distance, strip);
  keep_below(-across(a), -across(b), distance, strip);
  if (strip.begin < strip.end) join(strip);
  return found;
}

}  // namespace

LineArrangement::LineArrangement(std::vector<Point2> points, std::vector<Segment> segments, double distance)
    : points_(std::move(points)), segments_(std::move(segments)), distance_(distance) {}

double LineArrangement::add(const Point2& a, const Point2& b) {
  if (length(a, b) < kShortest * distance_) return 0.0;
  double added = 0.0;
  for (const Stretch& part : new_parts(a, b)) added += insert(between(a, b, part.begin), between(a, b, part.end));
  return added;
}

std::vector<Stretch> LineArrangement::new_parts(const Point2& a, const Point2& b) const {
  const double l = length(a, b);
  std::vector<Stretch> taken;
  for (const Segment& s : segments_) {
    const auto near = near_segment(a, b, points_[s.from], points_[s.to], kAlongShare * distance_);
    if (!near || (near->end - near->begin) * l < kAlong * distance_) continue;
    taken.push_back({std::max(near->begin, 0.0), std::min(near->end, 1.0)});
  }
  std::sort(taken.begin(), taken.end(), [](const Stretch& s, const Stretch& t) { return s.begin < t.begin; });
  taken.push_back({1.0, 1.0});
  std::vector<Stretch> left;
  double reached = 0.0;
  for (const Stretch& s : taken) {
    if ((s.begin - reached) * l > kShortest * distance_) left.push_back({reached, s.begin});
    reached = std::max(reached, s.end);
  }
  return left;
}

std::uint32_t LineArrangement::split(std::size_t segment, const Point2& at) {
  const auto vertex = static_cast<std::uint32_t>(points_.size());
  points_.push_back(at);
  Segment second = segments_[segment];
  second.from = vertex;
  segments_[segment].to = vertex;
  segments_.push_back(second);
  return vertex;
}

std::uint32_t LineArrangement::snap(const Point2& p) {
  double nearest = distance_;
  std::uint32_t vertex = kNone;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    if (const double d = length(points_[i], p); d < nearest) {
      nearest = d;
      vertex = i;
    }
  }
  if (vertex != kNone) return vertex;
  nearest = distance_;
  std::size_t segment = segments_.size();
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Point2& a = points_[segments_[i].from];
    const Point2& b = points_[segments_[i].to];
    if (const double d = length(between(a, b, nearest_on(a, b, p)), p); d < nearest) {
      nearest = d;
      segment = i;
    }
  }
  if (segment < segments_.size()) {
    const Point2& a = points_[segments_[segment].from];
    const Point2& b = points_[segments_[segment].to];
    return split(segment, between(a, b, nearest_on(a, b, p)));
  }
  points_.push_back(p);
  return static_cast<std::uint32_t>(points_.size() - 1);
}

double LineArrangement::insert(const Point2& a, const Point2& b) {
  const std::uint32_t from = snap(a);
  const std::uint32_t to = snap(b);
  if (from == to) return 0.0;
  double added = 0.0;
  const std::vector<std::uint32_t> vertices = chain(from, to);
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    if (has_segment(vertices[i], vertices[i + 1])) continue;
    segments_.push_back({vertices[i], vertices[i + 1], false, true});
    added += length(points_[vertices[i]], points_[vertices[i + 1]]);
  }
  return added;
}

std::vector<std::uint32_t> LineArrangement::chain(std::uint32_t from, std::uint32_t to) {
  const Point2 a = points_[from];
  const Point2 b = points_[to];
  std::vector<std::pair<double, std::uint32_t>> on{{0.0, from}, {1.0, to}};
  std::vector<bool> taken(points_.size(), false);
  const auto take = [&](double t, std::uint32_t vertex) {
    if (vertex < taken.size()) {
      if (taken[vertex]) return;
      taken[vertex] = true;
    }
    on.emplace_back(t, vertex);
  };
  taken[from] = true;
  taken[to] = true;
  for (std::uint32_t i = 0; i < taken.size(); ++i) {
    const double t = nearest_on(a, b, points_[i]);
    if (t > 0.0 && t < 1.0 && length(between(a, b, t), points_[i]) < distance_) take(t, i);
  }
  const std::size_t count = segments_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Segment s = segments_[i];
    if (taken[s.from] || taken[s.to]) continue;
    const double side_from = doubled_area(a, b, points_[s.from]);
    const double side_to = doubled_area(a, b, points_[s.to]);
    const double side_a = doubled_area(points_[s.from], points_[s.to], a);
    const double side_b = doubled_area(points_[s.from], points_[s.to], b);
    if ((side_from > 0.0) == (side_to > 0.0) || (side_a > 0.0) == (side_b > 0.0)) continue;
    const Point2 at = between(points_[s.from], points_[s.to], side_from / (side_from - side_to));
    const double t = nearest_on(a, b, at);
    if (length(at, points_[s.from]) < distance_) {
      take(t, s.from);
    } else if (length(at, points_[s.to]) < distance_) {
      take(t, s.to);
    } else {
      take(t, split(i, at));
    }
  }
  std::sort(on.begin(), on.end());
  std::vector<std::uint32_t> vertices;
  for (const auto& [t, vertex] : on) vertices.push_back(vertex);
  return vertices;
}

bool LineArrangement::has_segment(std::uint32_t a, std::uint32_t b) const {
  return std::any_of(segments_.begin(), segments_.end(),
                     [&](const Segment& s) { return (s.from == a && s.to == b) || (s.from == b && s.to == a); });
}

}  // namespace clerestory::mesh
