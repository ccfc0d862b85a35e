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

/// The edge that goes on from each edge's end [edges]; none where several begin there.
std::vector<std::uint32_t> successors(std::span<const Edge> edges) {
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

std::vector<std::array<std::uint32_t, 3>> triangles_across(std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<std::array<std::uint32_t, 3>> across(triangles.size(), {kNoTriangle, kNoTriangle, kNoTriangle});
  struct Walked {
    Edge edge;
    std::uint32_t triangle;
    std::uint32_t k;
  };
  std::vector<Walked> walked;
  walked.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[t][k];
      const std::uint32_t to = triangles[t][(k + 1) % 3];
      walked.push_back({{std::min(from, to), std::max(from, to)}, t, k});
    }
  }
  std::ranges::sort(walked, {}, &Walked::edge);
  for (std::size_t i = 1; i < walked.size(); ++i) {
    if (walked[i].edge != walked[i - 1].edge) continue;
    across[walked[i].triangle][walked[i].k] = walked[i - 1].triangle;
    across[walked[i - 1].triangle][walked[i - 1].k] = walked[i].triangle;
  }
  return across;
}

std::vector<std::array<std::uint32_t, 2>> group_outline(std::span<const Point> vertices,
                                                        std::span<const std::array<std::uint32_t, 2>> edges) {
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
