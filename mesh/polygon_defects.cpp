// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/polygon_defects.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>

#include "mesh/hash.h"
#include "mesh/simple_loops.h"
#include "mesh/t_junctions.h"

namespace clerestory::mesh {

namespace {

/// Corners this near to a line lie on it but for the rounding of coordinates of a few hundred metres [m].
constexpr double kNoWidth = 1e-9;

Point place_of(const Soup& soup, const SoupPolygon& polygon) {
  const bool nowhere = polygon.loops.empty() || polygon.loops.front().empty();
  return nowhere ? Point{} : soup.points[polygon.loops.front().front()];
}

enum class Shape { kWide, kNeedle, kNothing };

/// A needle's corners all lie so near to the line between the two farthest of them that splitting the edges there at the others
/// makes the polygons on its two sides meet: it can go without a gap.
Shape shape_of(const std::vector<Point>& points, const std::vector<std::uint32_t>& loop, double tolerance) {
  if (loop.size() < 3) return Shape::kNothing;
  const auto farthest_from = [&](const Point& p) {
    return points[*std::max_element(loop.begin(), loop.end(), [&](std::uint32_t a, std::uint32_t b) {
      return norm(points[a] - p) < norm(points[b] - p);
    })];
  };
  const Point a = farthest_from(points[loop[0]]);
  const Vector axis = normalized(farthest_from(a) - a);
  double width = 0.0;
  for (const std::uint32_t corner : loop) width = std::max(width, norm(cross(points[corner] - a, axis)));
  if (width > kOnEdgeShare * tolerance) return Shape::kWide;
  return width > kNoWidth ? Shape::kNeedle : Shape::kNothing;
}

bool drop_degenerate_holes(const Soup& soup, SoupPolygon& polygon, double tolerance, DefectList& defects) {
  bool changed = false;
  for (std::size_t l = polygon.loops.size() - 1; l > 0; --l) {
    if (shape_of(soup.points, polygon.loops[l], tolerance) == Shape::kWide) continue;
    const Point place = polygon.loops[l].empty() ? place_of(soup, polygon) : soup.points[polygon.loops[l][0]];
    defects.add("degenerate holes", {polygon.source, place});
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

/// The same for the same edges in any order and direction.
std::uint64_t hash_of_edges(const SoupPolygon& polygon) {
  std::uint64_t sum = 0;
  for_each_edge(polygon, [&](std::uint32_t a, std::uint32_t b) {
    const Edge edge = edge_between(a, b);
    sum += hash(edge[0], edge[1]);
  });
  return sum;
}

/// Whether two polygons of the same edges look the same way in the file.
bool look_alike(const Soup& soup, const SoupPolygon& a, const SoupPolygon& b) {
  const bool alike = dot(newell(soup.points, a.loops[0]), newell(soup.points, b.loops[0])) > 0.0;
  return alike == (a.flipped == b.flipped);
}

/// Whether the material of a polygon becomes that of the back of its twin.
bool gives_back(const Soup& soup, const SoupPolygon& polygon, const SoupPolygon& twin, const MaterialFacts& materials) {
  const auto passes = [&](const SoupPolygon& p) {
    return p.material.index() < materials.passable.size() && materials.passable[p.material.index()];
  };
  return !twin.back_material.valid() && !passes(polygon) && !passes(twin) && !look_alike(soup, polygon, twin);
}

/// Tells of a polygon that lies on its twin, unless the twin gets its material on the back: then nothing is lost.
void merge_into(SoupPolygon& twin, const SoupPolygon& polygon, const Soup& soup, const MaterialFacts& materials,
                DefectList& defects) {
  const DefectPlace place{polygon.source, place_of(soup, polygon), std::sqrt(area(soup.points, polygon))};
  const std::string& kept = materials.names[twin.material.index()];
  const std::string& other = materials.names[polygon.material.index()];
  if (twin.material == polygon.material) {
    defects.add("duplicate polygons", place);
  } else if (gives_back(soup, polygon, twin, materials)) {
    twin.back_material = polygon.material;
  } else {
    defects.add("duplicate polygons of different material", place, kept + " kept, " + other + " dropped");
  }
}

}  // namespace

bool drop_degenerate(Soup& soup, double tolerance, DefectList& defects) {
  bool changed = false;
  std::erase_if(soup.polygons, [&](const SoupPolygon& polygon) {
    const bool empty = polygon.loops.empty() || polygon.loops.front().empty();
    if (empty) defects.add("degenerate polygons", {polygon.source, {}});
    changed = changed || empty;
    return empty;
  });
  changed |= separate_loops(soup, defects);
  std::vector<SoupPolygon> kept;
  kept.reserve(soup.polygons.size());
  for (SoupPolygon& polygon : soup.polygons) {
    const Shape shape = polygon.loops.empty() ? Shape::kNothing : shape_of(soup.points, polygon.loops[0], tolerance);
    if (shape != Shape::kWide || !plane_of(soup.points, polygon, 0.0)) {
      defects.add(shape == Shape::kNeedle ? "needle polygons" : "degenerate polygons",
                  {polygon.source, place_of(soup, polygon)});
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

void drop_duplicates(Soup& soup, const MaterialFacts& materials, DefectList& defects) {
  std::unordered_multimap<std::uint64_t, std::uint32_t> seen;  // hash of the edges → index in kept
  seen.reserve(soup.polygons.size());
  std::vector<SoupPolygon> kept;
  kept.reserve(soup.polygons.size());
  for (SoupPolygon& polygon : soup.polygons) {
    const std::uint64_t key = hash_of_edges(polygon);
    SoupPolygon* twin = nullptr;
    for (auto [i, end] = seen.equal_range(key); i != end && twin == nullptr; ++i) {
      if (sorted_edges(kept[i->second]) == sorted_edges(polygon)) twin = &kept[i->second];
    }
    if (twin == nullptr) {
      seen.emplace(key, static_cast<std::uint32_t>(kept.size()));
      kept.push_back(std::move(polygon));
      continue;
    }
    merge_into(*twin, polygon, soup, materials, defects);
  }
  soup.polygons = std::move(kept);
}

}  // namespace clerestory::mesh
