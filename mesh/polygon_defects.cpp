// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/polygon_defects.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

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
    const std::vector<std::uint32_t> before = polygon.loops[l];
    changed |= drop_repeated_corners(polygon.loops[l]);
    if (!is_degenerate(soup.points, polygon.loops[l], tolerance)) continue;
    defects.add("degenerate holes", polygon.source, soup.points[before.front()]);
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

bool drop_repeated_corners(std::vector<std::uint32_t>& loop) {
  const std::size_t before = loop.size();
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t corner : loop) {
    if (!kept.empty() && kept.back() == corner) continue;
    if (kept.size() >= 2 && kept[kept.size() - 2] == corner) {
      kept.pop_back();
      continue;
    }
    kept.push_back(corner);
  }
  // The same where the loop closes.
  std::size_t begin = 0;
  std::size_t end = kept.size();
  while (end - begin >= 2) {
    if (kept[begin] == kept[end - 1]) {
      --end;
    } else if (end - begin >= 3 && kept[begin] == kept[end - 2]) {
      end -= 2;
    } else if (end - begin >= 3 && kept[begin + 1] == kept[end - 1]) {
      ++begin;
      --end;
    } else {
      break;
    }
  }
  loop.assign(kept.begin() + static_cast<std::ptrdiff_t>(begin), kept.begin() + static_cast<std::ptrdiff_t>(end));
  return loop.size() != before;
}

bool drop_degenerate(Soup& soup, double tolerance, DefectList& defects) {
  bool changed = false;
  std::vector<SoupPolygon> kept;
  kept.reserve(soup.polygons.size());
  for (SoupPolygon& polygon : soup.polygons) {
    const Point place = place_of(soup, polygon);
    const bool repeated = !polygon.loops.empty() && drop_repeated_corners(polygon.loops.front());
    if (!plane_of(soup.points, polygon, tolerance)) {
      defects.add("degenerate polygons", polygon.source, place);
      changed = true;
      continue;
    }
    if (repeated) defects.add("repeated corners", polygon.source, place);
    changed |= repeated;
    changed |= drop_degenerate_holes(soup, polygon, tolerance, defects);
    kept.push_back(std::move(polygon));
  }
  soup.polygons = std::move(kept);
  return changed;
}

void drop_unusable(Soup& soup) {
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
