// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/face_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "mesh/line_arrangement.h"

namespace clerestory::mesh {

namespace {

/// Components narrower than this share of the distance between lines come from rounding.
constexpr double kSliverShare = 1e-3;

using Segment = LineArrangement::Segment;

/// The constrained edges of a triangulation, each once: those of one triangle alone bound the face, which lies on their left.
std::vector<Segment> constrained_edges(const PlanarMesh& mesh) {
  std::map<std::array<std::uint32_t, 2>, bool> directed;
  for (const PlanarTriangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if ((t.constrained >> k & 1U) != 0) directed[{t.vertices[k], t.vertices[(k + 1) % 3]}] = true;
    }
  }
  std::vector<Segment> segments;
  for (const auto& [edge, present] : directed) {
    const bool twice = directed.contains({edge[1], edge[0]});
    if (!twice || edge[0] < edge[1]) segments.push_back({edge[0], edge[1], !twice, false});
  }
  return segments;
}

/// Triangulates what the arrangement holds.
PlanarMesh triangulated(const LineArrangement& arrangement, double distance) {
  PlanarGraph graph;
  graph.points = arrangement.points();
  std::vector<std::array<std::uint32_t, 2>> boundary;
  for (const Segment& s : arrangement.segments()) {
    graph.segments.push_back({s.from, s.to});
    if (s.boundary) boundary.push_back({s.from, s.to});
  }
  return triangulate_inside(std::move(graph), boundary, kSliverShare * distance);
}

/// How far inside of a triangle a point is: its least barycentric coordinate.
double depth_in(const PlanarMesh& mesh, const PlanarTriangle& t, const Point2& p) {
  const Point2& a = mesh.points[t.vertices[0]];
  const Point2& b = mesh.points[t.vertices[1]];
  const Point2& c = mesh.points[t.vertices[2]];
  const double area = doubled_area(a, b, c);
  if (area <= 0.0) return -std::numeric_limits<double>::infinity();
  return std::min({doubled_area(a, b, p), doubled_area(b, c, p), doubled_area(c, a, p)}) / area;
}

std::uint32_t component_at(const PlanarMesh& mesh, const Point2& p) {
  double deepest = -std::numeric_limits<double>::infinity();
  std::uint32_t component = 0;
  for (const PlanarTriangle& t : mesh.triangles) {
    if (const double depth = depth_in(mesh, t, p); depth > deepest) {
      deepest = depth;
      component = t.component;
    }
  }
  return component;
}

/// For each patch the component of the coarse mesh in which its middle lies.
std::vector<std::uint32_t> regions_of_patches(const PlanarMesh& coarse, const PlanarMesh& mesh) {
  std::vector<std::uint32_t> regions;
  for (const Point2& p : component_middles(mesh))
    regions.push_back(coarse.component_count > 1 ? component_at(coarse, p) : 0);
  return regions;
}

/// Whether each component of the coarse mesh has a patch: one that is a rounded sliver may have been lost with the lines.
bool all_there(const std::vector<std::uint32_t>& region_of_patch, std::uint32_t regions) {
  std::vector<bool> there(regions, false);
  for (const std::uint32_t r : region_of_patch) there[r] = true;
  return std::find(there.begin(), there.end(), false) == there.end();
}

LinedMesh without_lines(PlanarMesh coarse) {
  LinedMesh result;
  result.region_of_patch.resize(coarse.component_count);
  std::iota(result.region_of_patch.begin(), result.region_of_patch.end(), 0U);
  result.mesh = std::move(coarse);
  return result;
}

/// Whether a triangulation has no more vertices than the arrangement, which then held all crossings, and no triangle too thin to be refined.
bool is_sound(const PlanarMesh& mesh, std::size_t points, double distance) {
  if (mesh.points.size() > points) return false;
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const PlanarTriangle& t) {
    const Point2& a = mesh.points[t.vertices[0]];
    const Point2& b = mesh.points[t.vertices[1]];
    const Point2& c = mesh.points[t.vertices[2]];
    const double longest = std::max(
        {std::hypot(b.x - a.x, b.y - a.y), std::hypot(c.x - b.x, c.y - b.y), std::hypot(a.x - c.x, a.y - c.y)});
    return doubled_area(a, b, c) > kSliverShare * distance * longest;
  });
}

/// Nothing where the mesh is not sound, or has lost a region.
std::optional<LinedMesh> try_lines(const PlanarMesh& coarse, std::span<const std::array<Point2, 2>> lines,
                                   double distance) {
  LineArrangement arrangement(coarse.points, constrained_edges(coarse), distance);
  LinedMesh result;
  for (const auto& [a, b] : lines) {
    const double added = arrangement.add(a, b);
    result.length_m += added;
    if (added == 0.0) ++result.merged;
  }
  result.mesh = triangulated(arrangement, distance);
  if (!is_sound(result.mesh, arrangement.points().size(), distance)) return std::nullopt;
  result.region_of_patch = regions_of_patches(coarse, result.mesh);
  if (!all_there(result.region_of_patch, coarse.component_count)) return std::nullopt;
  return result;
}

}  // namespace

LinedMesh with_lines(PlanarMesh coarse, std::span<const std::array<Point2, 2>> lines, double distance) {
  // Lines that bend at vertices may cross again, and give triangles that refinement cannot work with: then half of the lines go.
  for (std::size_t count = lines.size(); count > 0; count /= 2) {
    std::optional<LinedMesh> result = try_lines(coarse, lines.first(count), distance);
    if (!result) continue;
    result->left_out = lines.size() - count;
    return std::move(*result);
  }
  const std::size_t left_out = lines.size();
  LinedMesh result = without_lines(std::move(coarse));
  result.left_out = left_out;
  return result;
}

}  // namespace clerestory::mesh
