// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/edge_uses.h"

#include <algorithm>

namespace clerestory::mesh {

std::vector<EdgeUse> sorted_edge_uses(const Soup& soup) {
  std::size_t count = 0;
  for (const SoupPolygon& polygon : soup.polygons) {
    for (const std::vector<std::uint32_t>& loop : polygon.loops) count += loop.size();
  }
  std::vector<EdgeUse> uses;
  uses.reserve(count);
  for (std::uint32_t p = 0; p < soup.polygons.size(); ++p) {
    for_each_edge(soup.polygons[p], [&](std::uint32_t a, std::uint32_t b) {
      uses.push_back({edge_between(a, b), p, a < b});
    });
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

OpenEdges open_edges(const Soup& soup) {
  const std::vector<EdgeUse> uses = sorted_edge_uses(soup);
  OpenEdges open;
  for_each_edge_group(uses, [&](std::size_t first, std::size_t last) {
    if (last - first != 1) return;
    ++open.count;
    open.length_m += norm(soup.points[uses[first].edge[1]] - soup.points[uses[first].edge[0]]);
  });
  return open;
}

}  // namespace clerestory::mesh
