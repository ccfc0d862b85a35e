// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/simple_loops.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "mesh/planar.h"

namespace clerestory::mesh {

namespace {

using Loop = std::vector<std::uint32_t>;

/// Appends the loops without repeated vertices that a loop consists of; those of fewer than three corners are dropped.
void take_apart(const Loop& loop, std::vector<Loop>& simple) {
  Loop open;
  std::unordered_map<std::uint32_t, std::size_t> place;
  for (const std::uint32_t corner : loop) {
    const auto met = place.find(corner);
    if (met == place.end()) {
      place[corner] = open.size();
      open.push_back(corner);
      continue;
    }
    const auto begin = open.begin() + static_cast<std::ptrdiff_t>(met->second);
    if (open.end() - begin >= 3) simple.emplace_back(begin, open.end());
    for (auto inner = begin + 1; inner != open.end(); ++inner) place.erase(*inner);
    open.erase(begin + 1, open.end());
  }
  if (open.size() >= 3) simple.push_back(std::move(open));
}

bool has_repeated_vertex(const Loop& loop) {
  Loop sorted = loop;
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

/// Whether most edges of a loop lie inside another: most, since the two may touch.
bool lies_in(const std::vector<Point2>& inner, const PlanarOutline& outer) {
  std::size_t inside = 0;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const Point2& a = inner[i];
    const Point2& b = inner[(i + 1) % inner.size()];
    if (outer.winding({0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}) != 0) ++inside;
  }
  return 2 * inside > inner.size();
}

/// How simple loops of one plane lie in each other.
struct Nesting {
  std::vector<std::vector<std::size_t>> around;  ///< the loops around each loop
  std::vector<double> area;                      ///< signed [m²]

  Nesting(const std::vector<Point>& points, const std::vector<Loop>& loops, const PlaneCoordinates& plane)
      : around(loops.size()), area(loops.size(), 0.0) {
    std::vector<std::vector<Point2>> flat(loops.size());
    std::vector<PlanarOutline> outlines;
    for (std::size_t l = 0; l < loops.size(); ++l) {
      for (const std::uint32_t corner : loops[l]) flat[l].push_back(plane.project(points[corner]));
      std::vector<PlanarOutline::Segment> segments;
      for (std::size_t i = 0; i < flat[l].size(); ++i) {
        segments.push_back({flat[l][i], flat[l][(i + 1) % flat[l].size()]});
        area[l] += 0.5 * doubled_area(flat[l][0], segments.back()[0], segments.back()[1]);
      }
      outlines.emplace_back(std::move(segments));
    }
    for (std::size_t l = 0; l < loops.size(); ++l) {
      for (std::size_t o = 0; o < loops.size(); ++o) {
        if (o != l && std::abs(area[o]) > std::abs(area[l]) && lies_in(flat[l], outlines[o])) around[l].push_back(o);
      }
    }
  }

  [[nodiscard]] bool is_hole(std::size_t loop) const { return around[loop].size() % 2 == 1; }
  /// The outer loop that a hole is cut from: the smallest around it that is no hole.
  [[nodiscard]] std::size_t outer_of(std::size_t hole) const {
    std::size_t best = std::numeric_limits<std::size_t>::max();
    for (const std::size_t o : around[hole]) {
      if (is_hole(o)) continue;
      if (best == std::numeric_limits<std::size_t>::max() || std::abs(area[o]) < std::abs(area[best])) best = o;
    }
    return best;
  }
};

/// Polygons of one outer loop each, like the given one in all else; its largest loop says which side is the front.
std::vector<SoupPolygon> nested_polygons(const std::vector<Point>& points, const SoupPolygon& polygon,
                                         std::vector<Loop> loops, const Plane& plane) {
  const Nesting nesting(points, loops, {plane.origin, frame_around(plane.normal)});
  std::vector<SoupPolygon> result;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const bool front = nesting.area[l] > 0.0;
    if (front == nesting.is_hole(l)) std::reverse(loops[l].begin(), loops[l].end());
  }
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (nesting.is_hole(l)) continue;
    SoupPolygon own = polygon;
    own.loops = {loops[l]};
    for (std::size_t h = 0; h < loops.size(); ++h) {
      if (nesting.is_hole(h) && nesting.outer_of(h) == l) own.loops.push_back(loops[h]);
    }
    result.push_back(std::move(own));
  }
  return result;
}

/// The plane of the largest loop.
std::optional<Plane> main_plane(const std::vector<Point>& points, const std::vector<Loop>& loops) {
  SoupPolygon largest;
  double most = -1.0;
  for (const Loop& loop : loops) {
    const double size = norm(newell(points, loop));
    if (size <= most) continue;
    most = size;
    largest.loops = {loop};
  }
  return plane_of(points, largest, 0.0);
}

void append_simple(const Soup& soup, SoupPolygon polygon, DefectList& defects, std::vector<SoupPolygon>& result) {
  std::vector<Loop> simple;
  for (const Loop& loop : polygon.loops) take_apart(loop, simple);
  const Point place = soup.points[polygon.loops.front().front()];
  const bool more = simple.size() > polygon.loops.size();
  const std::optional<Plane> plane = more ? main_plane(soup.points, simple) : std::nullopt;
  if (!plane) {
    // What vanishes altogether is counted as degenerate by the caller.
    if (!simple.empty()) defects.add("repeated corners", {polygon.source, place});
    polygon.loops = std::move(simple);
    result.push_back(std::move(polygon));
    return;
  }
  defects.add("bridged loops", {polygon.source, place});
  for (SoupPolygon& own : nested_polygons(soup.points, polygon, std::move(simple), *plane)) {
    result.push_back(std::move(own));
  }
}

}  // namespace

bool separate_loops(Soup& soup, DefectList& defects) {
  const auto repeats = [](const SoupPolygon& polygon) {
    return std::any_of(polygon.loops.begin(), polygon.loops.end(), has_repeated_vertex);
  };
  if (std::none_of(soup.polygons.begin(), soup.polygons.end(), repeats)) return false;
  std::vector<SoupPolygon> result;
  result.reserve(soup.polygons.size());
  for (SoupPolygon& polygon : soup.polygons) {
    if (repeats(polygon)) {
      append_simple(soup, std::move(polygon), defects, result);
    } else {
      result.push_back(std::move(polygon));
    }
  }
  soup.polygons = std::move(result);
  return true;
}

}  // namespace clerestory::mesh
