// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/t_junctions.h"

#include <algorithm>
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

/// The line a + t·d, 0 ≤ t ≤ 1, for tests against boxes. Slabs [Kay, Kajiya 1986].
class Slabs {
 public:
  Slabs(const Point& a, const Vector& d) : a_(a), inverse_{1.0 / d.x, 1.0 / d.y, 1.0 / d.z} {}

  /// Whether the line comes into the box grown by a margin.
  [[nodiscard]] bool meet(const Box& box, double margin) const {
    double begin = 0.0;
    double end = 1.0;
    clip(box.low.x - margin - a_.x, box.high.x + margin - a_.x, inverse_.x, begin, end);
    clip(box.low.y - margin - a_.y, box.high.y + margin - a_.y, inverse_.y, begin, end);
    clip(box.low.z - margin - a_.z, box.high.z + margin - a_.z, inverse_.z, begin, end);
    return begin <= end;
  }

 private:
  // Along an axis that the line does not go, inverse is infinite: so are t0 and t1, of opposite signs inside and of one sign outside.
  static void clip(double low, double high, double inverse, double& begin, double& end) {
    const double t0 = low * inverse;
    const double t1 = high * inverse;
    begin = std::max(begin, std::min(t0, t1));
    end = std::min(end, std::max(t0, t1));
  }

  Point a_;
  Vector inverse_;
};

struct Found {
  double t = 0.0;
  std::uint32_t vertex = 0;
  bool operator<(const Found& other) const { return t != other.t ? t < other.t : vertex < other.vertex; }
};

/// An edge, and a polygon that has it.
using UsedEdge = std::pair<Edge, std::uint32_t>;

/// Each edge once, by vertices: so neighbours in the list are neighbours in space as a rule.
std::vector<UsedEdge> edges_of(const Soup& soup) {
  std::vector<UsedEdge> edges;
  for (std::uint32_t p = 0; p < soup.polygons.size(); ++p) {
    for_each_edge(soup.polygons[p], [&](std::uint32_t a, std::uint32_t b) {
      if (a != b) edges.emplace_back(edge_between(a, b), p);
    });
  }
  std::sort(edges.begin(), edges.end());
  const auto same_edge = [](const UsedEdge& a, const UsedEdge& b) { return a.first == b.first; };
  edges.erase(std::unique(edges.begin(), edges.end(), same_edge), edges.end());
  return edges;
}

/// The vertices on each edge; edges without any are left out.
EdgeSplits find_splits(const SegmentSearch& search, const std::vector<UsedEdge>& edges) {
  EdgeSplits splits;
  for (const auto& [edge, polygon] : edges) {
    std::vector<std::uint32_t> inner = search.on(edge);
    if (!inner.empty()) splits.emplace(edge, std::move(inner));
  }
  return splits;
}

/// The edges that the splits make, each once.
std::vector<UsedEdge> pieces_of(const std::vector<UsedEdge>& edges, const EdgeSplits& splits) {
  std::vector<UsedEdge> pieces;
  std::vector<std::uint32_t> chain;
  for (const auto& [edge, polygon] : edges) {
    if (!splits.contains(edge)) continue;
    chain.clear();
    append_chain(edge[0], edge[1], splits, chain);
    chain.push_back(edge[1]);
    for (std::size_t i = 1; i < chain.size(); ++i) {
      pieces.emplace_back(edge_between(chain[i - 1], chain[i]), polygon);
    }
  }
  std::sort(pieces.begin(), pieces.end());
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  return pieces;
}

void split_loop(std::vector<std::uint32_t>& loop, const EdgeSplits& splits) {
  const auto next = [&](std::size_t i) { return loop[(i + 1) % loop.size()]; };
  std::size_t first = 0;
  while (first < loop.size() && !splits.contains(edge_between(loop[first], next(first)))) ++first;
  if (first == loop.size()) return;
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < loop.size(); ++i) append_chain(loop[i], next(i), splits, result);
  loop = std::move(result);
}

}  // namespace

SegmentSearch::SegmentSearch(std::span<const Point> points, double tolerance, std::size_t first)
    : points_(points), distance_(kOnEdgeShare * tolerance), tree_(boxes_of(points, first)) {}

std::vector<std::uint32_t> SegmentSearch::on(const Edge& edge) const {
  const Point& a = points_[edge[0]];
  const Vector d = points_[edge[1]] - a;
  const double length_squared = dot(d, d);
  std::vector<Found> found;
  const Slabs slabs(a, d);
  tree_.visit([&](const Box& box) { return slabs.meet(box, distance_); },
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
  std::vector<UsedEdge> edges = edges_of(soup);
  bool changed = false;
  for (int round = 0; round < kMaxRounds && !edges.empty(); ++round) {
    const EdgeSplits splits = find_splits(search, edges);
    if (splits.empty()) break;
    changed = true;
    for (const auto& [edge, polygon] : edges) {
      const auto split = splits.find(edge);
      if (split == splits.end()) continue;
      for (const std::uint32_t vertex : split->second) {
        defects.add("T-junctions", {soup.polygons[polygon].source, soup.points[vertex]});
      }
    }
    for (SoupPolygon& polygon : soup.polygons) {
      for (std::vector<std::uint32_t>& loop : polygon.loops) split_loop(loop, splits);
    }
    edges = pieces_of(edges, splits);
  }
  return changed;
}

}  // namespace clerestory::mesh
