// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/soup.h"
#include "mesh/t_junctions.h"

// Private to mesh/.
namespace clerestory::mesh {

/// That a polygon has an edge.
struct EdgeUse {
  Edge edge{};
  std::uint32_t polygon = 0;
  bool forward = false;  ///< the polygon walks from edge[0] to edge[1]
  auto operator<=>(const EdgeUse&) const = default;
};

/// All uses of edges, sorted: those of one edge stand together.
std::vector<EdgeUse> sorted_edge_uses(const Soup& soup);

/// Calls visit(first, last) for the range of uses of each edge.
template <class Visit>
void for_each_edge_group(const std::vector<EdgeUse>& uses, const Visit& visit) {
  for (std::size_t first = 0; first < uses.size();) {
    std::size_t last = first + 1;
    while (last < uses.size() && uses[last].edge == uses[first].edge) ++last;
    visit(first, last);
    first = last;
  }
}

/// Edges that one polygon alone has.
struct OpenEdges {
  std::size_t count = 0;
  double length_m = 0.0;
};
OpenEdges open_edges(const Soup& soup);

}  // namespace clerestory::mesh
