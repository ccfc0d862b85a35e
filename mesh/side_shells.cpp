// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/side_shells.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <utility>

#include "mesh/disjoint_sets.h"

namespace clerestory::mesh {

namespace {

/// That a triangle has an edge from vertex `low` to vertex `high`, or the other way round.
struct TriangleEdge {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  std::uint32_t apex = 0;
  bool forward = false;
  auto operator<=>(const TriangleEdge&) const = default;
};

/// All edges of triangles that bound regions, those of one edge together.
std::vector<TriangleEdge> bounding_edges(const Faces& faces) {
  std::vector<TriangleEdge> edges;
  for (std::uint32_t t = 0; t < faces.shape.triangles.size(); ++t) {
    const Triangle& triangle = faces.shape.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      if ((triangle.constrained >> k & 1U) == 0) continue;
      const std::uint32_t from = triangle.vertices[k];
      const std::uint32_t to = triangle.vertices[(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), t, triangle.vertices[(k + 2) % 3], from < to});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// A triangle at an edge: where it stands round it, and the sides that look on and back.
struct Leaf {
  double angle_rad = 0.0;
  std::uint32_t ahead = 0;
  std::uint32_t behind = 0;
};

/// The triangles round one edge, in turn, counter-clockwise as seen against its direction.
std::vector<Leaf> leaves(const Faces& faces, const Regions& regions, const TriangleEdge* first,
                         const TriangleEdge* last) {
  const auto& v = faces.shape.vertices;
  const Frame frame = frame_around(normalized(v[first->high] - v[first->low]));
  std::vector<Leaf> found;
  for (const TriangleEdge* edge = first; edge != last; ++edge) {
    const Vector out = v[edge->apex] - v[edge->low];
    const std::uint32_t front = 2 * regions.of_triangle[edge->triangle];
    found.push_back({std::atan2(dot(out, frame.v), dot(out, frame.u)), edge->forward ? front : front + 1,
                     edge->forward ? front + 1 : front});
  }
  std::stable_sort(found.begin(), found.end(), [](const Leaf& a, const Leaf& b) { return a.angle_rad < b.angle_rad; });
  return found;
}

}  // namespace

std::vector<std::uint32_t> side_shells(const Faces& faces, const Regions& regions) {
  DisjointSets<std::uint32_t> shells(2 * regions.count());
  const std::vector<TriangleEdge> edges = bounding_edges(faces);
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && edges[last].low == edges[first].low && edges[last].high == edges[first].high) ++last;
    const std::vector<Leaf> round = leaves(faces, regions, edges.data() + first, edges.data() + last);
    for (std::size_t i = 0; i < round.size(); ++i) shells.join(round[i].ahead, round[(i + 1) % round.size()].behind);
    first = last;
  }
  std::vector<std::uint32_t> of_side(2 * regions.count());
  for (std::uint32_t n = 0; n < of_side.size(); ++n) of_side[n] = shells.root(n);
  return of_side;
}

}  // namespace clerestory::mesh
