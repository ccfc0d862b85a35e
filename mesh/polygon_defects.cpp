// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/polygon_defects.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "mesh/simple_loops.h"
#include "mesh/t_junctions.h"

namespace clerestory::mesh {

namespace {

Point place_of(const Soup& soup, const SoupPolygon& polygon) {
  const bool nowhere = polygon.loops.empty() || polygon.loops.front().empty();
  return nowhere ? Point{} : soup.points[polygon.loops.front().front()];
}

bool is_degenerate(const std::vector<Point>& points, const std::vector<std::uint32_t>& loop, double tolerance) {
  SoupPolygon alone;
  alone.loops.push_back(loop);
  return !plane_of(points, alone, tolerance);
}

bool drop_degenerate_holes(const Soup& soup, SoupPolygon& polygon, double tolerance, DefectList& defects) {
  bool changed = false;
  for (std::size_t l = polygon.loops.size() - 1; l > 0; --l) {
    if (!is_degenerate(soup.points, polygon.loops[l], tolerance)) continue;
    const Point place = polygon.loops[l].empty() ? place_of(soup, polygon) : soup.points[polygon.loops[l][0]];
    defects.add("degenerate holes", polygon.source, place);
    polygon.loops.erase(polygon.loops.begin() + static_cast<std::ptrdiff_t>(l));
    changed = true;
  }
  return changed;
}

std::vector<Edge> sorted_edges(const SoupPolygon& polygon) {
  std::vector<Edge> edges;
  for_each_edge(polygon, [&](std::uint32_t a, std::uint32_t b) { edges.push_back(edge_between(a, b)); });
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

bool drop_degenerate(Soup& soup, double tolerance, DefectList& defects) {
  bool changed = false;
  std::erase_if(soup.polygons, [&](const SoupPolygon& polygon) {
    const bool empty = polygon.loops.empty() || polygon.loops.front().empty();
    if (empty) defects.add("degenerate polygons", polygon.source, {});
    changed = changed || empty;
    return empty;
  });
  changed |= separate_loops(soup, defects);
  std::vector<SoupPolygon> kept;
  kept.reserve(soup.polygons.size());
  for (SoupPolygon& polygon : soup.polygons) {
    if (!plane_of(soup.points, polygon, tolerance)) {
      defects.add("degenerate polygons", polygon.source, place_of(soup, polygon));
      changed = true;
      continue;
    }
    changed |= drop_degenerate_holes(soup, polygon, tolerance, defects);
    kept.push_back(std::move(polygon));
  }
  soup.polygons = std::move(kept);
  return changed;
}

void drop_unusable(Soup& soup) {
  DefectList ignored;
  std::erase_if(soup.polygons, [](const SoupPolygon& p) { return p.loops.empty() || p.loops.front().empty(); });
  separate_loops(soup, ignored);
  std::erase_if(soup.polygons, [&](const SoupPolygon& polygon) { return !plane_of(soup.points, polygon, 0.0); });
}

void drop_duplicates(Soup& soup, const std::vector<std::string>& material_names, DefectList& defects) {
  std::map<std::vector<Edge>, MaterialId> seen;
  std::vector<SoupPolygon> kept;
  kept.reserve(soup.polygons.size());
  for (SoupPolygon& polygon : soup.polygons) {
    const auto [first, fresh] = seen.try_emplace(sorted_edges(polygon), polygon.material);
    if (fresh) {
      kept.push_back(std::move(polygon));
    } else if (first->second == polygon.material) {
      defects.add("duplicate polygons", polygon.source, place_of(soup, polygon));
    } else {
      defects.add(
          "duplicate polygons of different material", polygon.source, place_of(soup, polygon),
          material_names[first->second.index()] + " kept, " + material_names[polygon.material.index()] + " dropped");
    }
  }
  soup.polygons = std::move(kept);
}

}  // namespace clerestory::mesh
