// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/planar_region.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace clerestory::mesh {

namespace {

/// Planes at a smaller angle than this have no line of intersection worth the name [rad].
constexpr double kParallelSine = 1e-6;

Point between(const Ends& s, double t) { return s[0] + t * (s[1] - s[0]); }

std::vector<PlanarOutline::Segment> flattened(const PlaneCoordinates& plane, std::span<const Ends> edges) {
  std::vector<PlanarOutline::Segment> segments;
  segments.reserve(edges.size());
  for (const Ends& edge : edges) segments.push_back({plane.project(edge[0]), plane.project(edge[1])});
  return segments;
}

/// The stretch of the line of the two planes that lies within the convex hull of g.
std::optional<Ends> common_line(const PlanarRegion& f, const PlanarRegion& g, double tolerance) {
  Vector direction = cross(f.plane.frame.w, g.plane.frame.w);
  if (norm(direction) < kParallelSine) return std::nullopt;
  direction = normalized(direction);
  Ends ends;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Ends& edge : g.edges) {
    const double da = f.plane.distance(edge[0]);
    const double db = f.plane.distance(edge[1]);
    if ((da > 0.0) == (db > 0.0)) continue;
    const Point p = between(edge, da / (da - db));
    const double t = dot(p - f.plane.origin, direction);
    if (t < low) ends[0] = p;
    if (t > high) ends[1] = p;
    low = std::min(low, t);
    high = std::max(high, t);
  }
  if (high - low <= tolerance) return std::nullopt;
  return ends;
}

std::vector<Stretch> inner_stretches(const PlanarRegion& region, const Ends& segment, double tolerance) {
  return region.outline.inner_stretches(region.plane.project(segment[0]), region.plane.project(segment[1]), tolerance);
}

}  // namespace

PlanarRegion::PlanarRegion(const PlaneCoordinates& in_plane, std::vector<Ends> boundary)
    : plane(in_plane), edges(std::move(boundary)), outline(flattened(plane, edges)) {}

std::vector<Ends> stretches_inside(const PlanarRegion& region, const Ends& segment, double tolerance) {
  std::vector<Ends> inside;
  for (const Stretch& s : inner_stretches(region, segment, tolerance)) {
    inside.push_back({between(segment, s.begin), between(segment, s.end)});
  }
  return inside;
}

std::vector<Ends> crossing_stretches(const PlanarRegion& f, const PlanarRegion& g, double tolerance) {
  std::vector<Ends> stretches;
  const std::optional<Ends> line = common_line(f, g, tolerance);
  if (!line) return stretches;
  const double length = norm((*line)[1] - (*line)[0]);
  const std::vector<Stretch> in_g = inner_stretches(g, *line, tolerance);
  for (const Stretch& s : inner_stretches(f, *line, tolerance)) {
    for (const Stretch& t : in_g) {
      const double begin = std::max(s.begin, t.begin);
      const double end = std::min(s.end, t.end);
      if ((end - begin) * length > tolerance) stretches.push_back({between(*line, begin), between(*line, end)});
    }
  }
  return stretches;
}

}  // namespace clerestory::mesh
