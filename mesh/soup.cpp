// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/soup.h"

#include <algorithm>
#include <limits>

namespace clerestory::mesh {

namespace {

// Files disagree on which way round holes go, and nothing depends on it.
void orient_holes(std::span<const Point> points, SoupPolygon& polygon) {
  for (std::size_t l = 1; l < polygon.loops.size(); ++l) {
    std::vector<std::uint32_t>& hole = polygon.loops[l];
    if (dot(newell(points, hole), newell(points, polygon.loops.front())) > 0.0) std::reverse(hole.begin(), hole.end());
  }
}

}  // namespace

Soup to_soup(const Model& model) {
  Soup soup;
  soup.points = model.vertices;
  soup.polygons.resize(model.polygon_count());
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    SoupPolygon& polygon = soup.polygons[p];
    for (std::size_t l = 0; l < model.loop_count(p); ++l) {
      const std::span<const std::uint32_t> loop = model.loop(p, l);
      polygon.loops.emplace_back(loop.begin(), loop.end());
    }
    orient_holes(soup.points, polygon);
    polygon.material = model.polygon_material[p];
    polygon.part = model.polygon_part[p];
    polygon.source = static_cast<std::uint32_t>(p);
    polygon.line = p < model.polygon_line.size() ? model.polygon_line[p] : 0;
  }
  return soup;
}

void flip(SoupPolygon& polygon) {
  for (std::vector<std::uint32_t>& loop : polygon.loops) std::reverse(loop.begin(), loop.end());
  polygon.flipped = !polygon.flipped;
}

Model to_model(const Soup& soup, const Model& names) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  Model model;
  model.material_names = names.material_names;
  model.part_names = names.part_names;
  model.curvature = names.curvature;
  std::vector<std::uint32_t> index(soup.points.size(), kUnused);
  for (const SoupPolygon& polygon : soup.polygons) {
    for_each_edge(polygon, [&](std::uint32_t a, std::uint32_t) { index[a] = 0; });
  }
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] == kUnused) continue;
    index[i] = static_cast<std::uint32_t>(model.vertices.size());
    model.vertices.push_back(soup.points[i]);
  }
  std::vector<std::uint32_t> corners;
  for (const SoupPolygon& polygon : soup.polygons) {
    model.begin_polygon(polygon.material, polygon.part, polygon.line);
    for (const std::vector<std::uint32_t>& loop : polygon.loops) {
      corners.clear();
      for (const std::uint32_t corner : loop) corners.push_back(index[corner]);
      model.add_loop(corners);
    }
  }
  return model;
}

// Relative to the first corner, so that large coordinates do not cancel.
Vector newell(std::span<const Point> points, std::span<const std::uint32_t> loop) {
  Vector sum;
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const Point& origin = points[loop[0]];
    sum = sum + cross(points[loop[i - 1]] - origin, points[loop[i]] - origin);
  }
  return sum;
}

double area(std::span<const Point> points, const SoupPolygon& polygon) {
  double total = 0.0;
  for (std::size_t l = 0; l < polygon.loops.size(); ++l) {
    const double loop_area = 0.5 * norm(newell(points, polygon.loops[l]));
    total += l == 0 ? loop_area : -loop_area;
  }
  return total;
}

std::optional<Plane> plane_of(std::span<const Point> points, const SoupPolygon& polygon, double tolerance) {
  if (polygon.loops.empty() || polygon.loops.front().size() < 3) return std::nullopt;
  const std::vector<std::uint32_t>& loop = polygon.loops.front();
  double perimeter = 0.0;
  Vector largest;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point& a = points[loop[i]];
    const Point& b = points[loop[(i + 1) % loop.size()]];
    const Point& c = points[loop[(i + 2) % loop.size()]];
    perimeter += norm(b - a);
    const Vector corner = cross(b - a, c - a);
    if (norm(corner) > norm(largest)) largest = corner;
  }
  // A strip of half the perimeter's length and the tolerance's width has the doubled area perimeter · tolerance.
  const double flat = perimeter * tolerance;
  Vector normal = newell(points, loop);
  if (norm(normal) <= flat) normal = largest;
  if (norm(normal) <= flat) return std::nullopt;
  normal = normalized(normal);
  double offset = 0.0;
  for (const std::uint32_t corner : loop) offset += dot(points[corner] - points[loop[0]], normal);
  return Plane{points[loop[0]] + (offset / static_cast<double>(loop.size())) * normal, normal};
}

}  // namespace clerestory::mesh
