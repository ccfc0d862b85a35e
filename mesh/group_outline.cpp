// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/group_outline.h"

#include <algorithm>
#include <limits>

namespace clerestory::mesh {

namespace {

using Edge = std::array<std::uint32_t, 2>;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Sine of the angle by which edges in a line may differ: rounding of points that were put on an edge.
constexpr double kInLine = 1e-9;

/// Edges without their reverse, in order.
std::vector<Edge> boundary(std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<Edge> sorted;
  sorted.reserve(3 * triangles.size());
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) sorted.push_back({t[k], t[(k + 1) % 3]});
  }
  const std::vector<Edge> edges = sorted;
  std::sort(sorted.begin(), sorted.end());
  std::vector<Edge> found;
  for (const Edge& e : edges) {
    if (!std::binary_search(sorted.begin(), sorted.end(), Edge{e[1], e[0]})) found.push_back(e);
  }
  return found;
}

/// The edge that goes on from each edge's end [edges]; none where several begin there.
std::vector<std::uint32_t> successors(const std::vector<Edge>& edges) {
  std::vector<std::array<std::uint32_t, 2>> by_begin;  // vertex and edge
  by_begin.reserve(edges.size());
  for (std::uint32_t i = 0; i < edges.size(); ++i) by_begin.push_back({edges[i][0], i});
  std::sort(by_begin.begin(), by_begin.end());
  std::vector<std::uint32_t> next(edges.size(), kNone);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto first = std::lower_bound(by_begin.begin(), by_begin.end(), Edge{edges[i][1], 0});
    if (first == by_begin.end() || (*first)[0] != edges[i][1]) continue;
    const auto second = first + 1;
    if (second == by_begin.end() || (*second)[0] != edges[i][1]) next[i] = (*first)[1];
  }
  return next;
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> group_outline(std::span<const Point> vertices,
                                                        std::span<const std::array<std::uint32_t, 3>> triangles) {
  const std::vector<Edge> edges = boundary(triangles);
  const std::vector<std::uint32_t> next = successors(edges);
  const auto along = [&](std::uint32_t e) { return vertices[edges[e][1]] - vertices[edges[e][0]]; };
  const auto goes_on = [&](std::uint32_t e) {
    if (next[e] == kNone) return false;
    const Vector a = along(e);
    const Vector b = along(next[e]);
    return dot(a, b) > 0.0 && norm(cross(a, b)) <= kInLine * norm(a) * norm(b);
  };
  std::vector<std::uint8_t> is_begun(edges.size(), 0);  // by the edge before
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (goes_on(e)) is_begun[next[e]] = 1;
  }
  std::vector<Edge> outline;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (is_begun[e] != 0) continue;
    std::uint32_t last = e;
    while (goes_on(last)) last = next[last];
    outline.push_back({edges[e][0], edges[last][1]});
  }
  return outline;
}

}  // namespace clerestory::mesh
