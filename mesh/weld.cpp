// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/weld.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "mesh/vertex_index.h"

namespace clerestory::mesh {

namespace {

void renumber(Soup& soup, const std::vector<std::uint32_t>& index) {
  for (SoupPolygon& polygon : soup.polygons) {
    for (std::vector<std::uint32_t>& loop : polygon.loops) {
      for (std::uint32_t& corner : loop) corner = index[corner];
    }
  }
}

}  // namespace

// In the order of the points, so that a welded soup comes back with the same numbers; points of no polygon attract none.
void weld(Soup& soup, double tolerance, DefectList& defects) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> user(soup.points.size(), kUnused);
  for (const SoupPolygon& polygon : soup.polygons) {
    for_each_edge(polygon, [&](std::uint32_t corner, std::uint32_t) {
      if (user[corner] == kUnused) user[corner] = polygon.source;
    });
  }
  VertexIndex index(tolerance);
  std::vector<std::uint32_t> welded(soup.points.size());
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    if (user[i] == kUnused) continue;
    const Point& p = soup.points[i];
    const std::size_t before = index.points().size();
    welded[i] = index.add(p);
    if (welded[i] == before) continue;
    const bool same = index[welded[i]] == p;
    defects.add(same ? "duplicate vertices" : "near-duplicate vertices", {user[i], p, norm(index[welded[i]] - p)});
  }
  renumber(soup, welded);
  soup.points.assign(index.points().begin(), index.points().end());
}

void share_vertices(Soup& soup) {
  std::vector<std::uint32_t> order(soup.points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    const Point& p = soup.points[i];
    return std::tuple(p.x, p.y, p.z, i);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> shared(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && soup.points[order[i]] == soup.points[order[i - 1]];
    shared[order[i]] = same ? shared[order[i - 1]] : order[i];
  }
  renumber(soup, shared);
}

}  // namespace clerestory::mesh
