// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "mesh/box_tree.h"
#include "mesh/defects.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// An undirected edge: two vertex indices, the smaller first.
using Edge = std::array<std::uint32_t, 2>;

constexpr Edge edge_between(std::uint32_t a, std::uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

struct EdgeHash {
  std::size_t operator()(const Edge& e) const {
    return static_cast<std::size_t>((static_cast<std::uint64_t>(e[0]) << 32U | e[1]) * 0x9E3779B97F4A7C15ULL);
  }
};

/// Per edge the vertices that lie on it, in order from its first vertex to its second.
using EdgeSplits = std::unordered_map<Edge, std::vector<std::uint32_t>, EdgeHash>;

/// Distance within which a vertex lies on an edge, as a share of the least distance between vertices. Below √3/2: then of three
/// vertices near each other at most one lies on the edge between the other two, so that splitting comes to an end.
constexpr double kOnEdgeShare = 0.85;

/// Finds the vertices that lie on segments.
class SegmentSearch {
 public:
  /// @param tolerance  no two points are closer than this [m]
  /// @param first  points before this one are not looked for
  SegmentSearch(std::span<const Point> points, double tolerance, std::size_t first = 0);

  /// The vertices within kOnEdgeShare of the tolerance of the inner part of the segment between two vertices, in order along
  /// it, without those two. O(log n) where few are near.
  [[nodiscard]] std::vector<std::uint32_t> on(const Edge& edge) const;

 private:
  std::span<const Point> points_;
  double distance_;
  BoxTree tree_;
};

/// Makes vertices on an edge, of whatever part, corners of that edge's polygon, until no such vertex is left.
/// Counts "T-junctions": vertices on edges.
/// @param tolerance  no two points are closer than this [m]
/// @return whether anything changed
bool split_t_junctions(Soup& soup, double tolerance, DefectList& defects);

/// Appends the first vertex of a directed edge and those that split it, without its last.
void append_chain(std::uint32_t from, std::uint32_t to, const EdgeSplits& splits, std::vector<std::uint32_t>& vertices);

}  // namespace clerestory::mesh
