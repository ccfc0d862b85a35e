// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/t_junctions.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace clerestory::mesh {

namespace {

/// Rounds of splitting. A split bends an edge by up to the tolerance, so that another vertex may come near it; in practice the
/// second round finds none.
constexpr int kMaxRounds = 8;

std::vector<Box> boxes_of(std::span<const Point> points, std::size_t first) {
  std::vector<Box> boxes(points.size());
  for (std::size_t i = first; i < points.size(); ++i) boxes[i].add(points[i]);
  return boxes;
}

/// Whether the line a + t·d, 0 ≤ t ≤ 1, meets the box. Slabs [Kay, Kajiya 1986].
bool meets(const Box& box, const Point& a, const Vector& d) {
  double begin = 0.0;
  double end = 1.0;
  const auto clip = [&](double low, double high, double origin, double step) {
    if (step == 0.0) return origin >= low && origin <= high;
    const double t0 = (low - origin) / step;
    const double t1 = (high - origin) / step;
    begin = std::max(begin, std::min(t0, t1));
    end = std::min(end, std::max(t0, t1));
    return begin <= end;
  };
  return clip(box.low.x, box.high.x, a.x, d.x) && clip(box.low.y, box.high.y, a.y, d.y) &&
         clip(box.low.z, box.high.z, a.z, d.z);
}

struct Found {
  double t = 0.0;
  std::uint32_t vertex = 0;
  bool operator<(const Found& other) const { return t != other.t ? t < other.t : vertex < other.vertex; }
};

std::vector<std::uint32_t> split_loop(std::span<const std::uint32_t> loop, const EdgeSplits& splits) {
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < loop.size(); ++i) append_chain(loop[i], loop[(i + 1) % loop.size()], splits, result);
  return result;
}

/// The edges of the polygons that have not been looked at before, in order of first use, each with a polygon that has it.
std::vector<std::pair<Edge, const SoupPolygon*>> new_edges(const Soup& soup,
                                                           std::unordered_set<Edge, EdgeHash>& known) {
  std::vector<std::pair<Edge, const SoupPolygon*>> edges;
  for (const SoupPolygon& polygon : soup.polygons) {
    for_each_edge(polygon, [&](std::uint32_t a, std::uint32_t b) {
      const Edge edge = edge_between(a, b);
      if (a != b && known.insert(edge).second) edges.emplace_back(edge, &polygon);
    });
  }
  return edges;
}

}  // namespace

SegmentSearch::SegmentSearch(std::span<const Point> points, double tolerance, std::size_t first)
    : points_(points), distance_(kOnEdgeShare * tolerance), tree_(boxes_of(points, first)) {}

std::vector<std::uint32_t> SegmentSearch::on(const Edge& edge) const {
  const Point& a = points_[edge[0]];
  const Vector d = points_[edge[1]] - a;
  const double length_squared = dot(d, d);
  std::vector<Found> found;
  tree_.visit([&](const Box& box) { return meets(grown(box, distance_), a, d); },
              [&](std::uint32_t vertex) {
                if (vertex == edge[0] || vertex == edge[1]) return;
                const Vector offset = points_[vertex] - a;
                const double t = dot(offset, d) / length_squared;
                if (t <= 0.0 || t >= 1.0 || norm(offset - t * d) > distance_) return;
                found.push_back({t, vertex});
              });
  std::sort(found.begin(), found.end());
  std::vector<std::uint32_t> vertices;
  for (const Found& f : found) vertices.push_back(f.vertex);
  return vertices;
}

void append_chain(std::uint32_t from, std::uint32_t to, const EdgeSplits& splits,
                  std::vector<std::uint32_t>& vertices) {
  vertices.push_back(from);
  const auto split = splits.find(edge_between(from, to));
  if (split == splits.end()) return;
  const std::vector<std::uint32_t>& inner = split->second;
  if (from < to) vertices.insert(vertices.end(), inner.begin(), inner.end());
  if (from > to) vertices.insert(vertices.end(), inner.rbegin(), inner.rend());
}

bool split_t_junctions(Soup& soup, double tolerance, DefectList& defects) {
  const SegmentSearch search(soup.points, tolerance);
  std::unordered_set<Edge, EdgeHash> known;
  bool changed = false;
  for (int round = 0; round < kMaxRounds; ++round) {
    EdgeSplits splits;
    for (const auto& [edge, polygon] : new_edges(soup, known)) {
      std::vector<std::uint32_t> inner = search.on(edge);
      if (inner.empty()) continue;
      for (const std::uint32_t vertex : inner) defects.add("T-junctions", {polygon->source, soup.points[vertex]});
      splits.emplace(edge, std::move(inner));
    }
    if (splits.empty()) break;
    changed = true;
    for (SoupPolygon& polygon : soup.polygons) {
      for (std::vector<std::uint32_t>& loop : polygon.loops) loop = split_loop(loop, splits);
    }
  }
  return changed;
}

}  // namespace clerestory::mesh
