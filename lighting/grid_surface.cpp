// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/grid_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clerestory::lighting {

namespace {

using mesh::Point;
using mesh::Vector;

/// Edges whose directions differ by less than this count as one direction: about a degree.
constexpr double kSameDirection = 0.017;
/// How far beside the edge of a hole it is looked at [m].
constexpr double kBeside = 0.02;
/// Below a surface by more than this is not on it any more [m].
constexpr double kVoidDepth = 0.05;
/// A surface that rises and falls by less than this is flat [m].
constexpr double kFlat = 1e-6;

double length_of(const std::vector<Point>& loop) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) sum += mesh::norm(loop[(i + 1) % loop.size()] - loop[i]);
  return sum;
}

/// An angle less its multiples of a right angle, in (-45°, 45°].
double within_right_angle(double angle) {
  constexpr double kRight = 0.5 * std::numbers::pi;
  const double rest = angle - kRight * std::round(angle / kRight);
  return rest <= -0.5 * kRight + 1e-12 ? rest + kRight : rest;
}

struct Direction {
  double angle;  ///< less right angles
  double weight;
};

/// The direction, less right angles, that most of the outline's length runs in.
double main_direction(const std::vector<std::vector<Point>>& loops) {
  std::vector<Direction> directions;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector d = loop[(i + 1) % loop.size()] - loop[i];
      const double angle = within_right_angle(std::atan2(d.y, d.x));
      const double weight = std::hypot(d.x, d.y);
      const auto same = std::ranges::find_if(directions, [&](const Direction& other) {
        return std::abs(within_right_angle(other.angle - angle)) < kSameDirection;
      });
      if (same == directions.end())
        directions.push_back({angle, weight});
      else
        same->weight += weight;
    }
  }
  Direction best{0.0, 0.0};
  for (const Direction& d : directions) {
    const bool as_heavy = d.weight > best.weight * (1.0 - 1e-9);
    if (d.weight > best.weight * (1.0 + 1e-9) || (as_heavy && std::abs(d.angle) < std::abs(best.angle))) best = d;
  }
  constexpr double kExactlyAligned = 1e-9;
  return std::abs(best.angle) < kExactlyAligned ? 0.0 : best.angle;
}

/// Level axes where the look is level or vertical as well as possible: u horizontal; for surfaces that look up, u and v as x and y.
mesh::Frame upright_frame(const Vector& look) {
  if (std::abs(look.z) > 0.999999) return {{1.0, 0.0, 0.0}, {0.0, look.z > 0.0 ? 1.0 : -1.0, 0.0}, look};
  const Vector u = mesh::normalized(mesh::cross({0.0, 0.0, 1.0}, look));
  return {u, mesh::cross(look, u), look};
}

mesh::Frame turned(const mesh::Frame& f, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * f.u + s * f.v, c * f.v - s * f.u, f.w};
}

std::vector<std::vector<Point>> transformed(const GridSurface& surface, std::vector<std::vector<Point>> loops) {
  for (auto& loop : loops) {
    for (Point& p : loop) p = surface.to_frame(p);
  }
  return loops;
}

/// Whether the surface ends at this hole: nothing is there (a stairwell), or a space of its own (a shaft, another room). It goes
/// on below furniture, and where a solid stands on it.
bool ends_surface(const GridSite& site, const GridSurface& surface, const std::vector<Point>& hole, double height_m) {
  const double width = -2.0 * signed_area(hole) / length_of(hole);
  const double beside = std::min(kBeside, 0.5 * width);
  const Vector look = surface.frame.w;
  std::size_t ends = 0;
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const Point& a = hole[i];
    const Point& b = hole[(i + 1) % hole.size()];
    const Vector along = mesh::normalized(Vector{b.x - a.x, b.y - a.y, 0.0});
    const Vector inwards{along.y, -along.x, 0.0};  // clockwise: the hole lies on the right
    const Point edge = mesh::midpoint(a, b) + Vector{0.0, 0.0, std::max(height_m, 0.01)};
    const Point outside = surface.to_local(edge - kBeside * inwards);
    const Point inside = surface.to_local(edge + beside * inwards);
    if (site.clear(outside, inside))
      ends += site.free_way(inside, -look) > height_m + kVoidDepth ? 1 : 0;
    else
      ends += inside_solid(site, inside, look) ? 0 : 1;
  }
  return 2 * ends >= hole.size();
}

}  // namespace

double signed_area(const std::vector<Point>& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector a = loop[i] - loop.front();
    const Vector b = loop[(i + 1) % loop.size()] - loop.front();
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

Point GridSurface::to_local(const Point& p) const { return Point{} + p.x * frame.u + p.y * frame.v + p.z * frame.w; }

Point GridSurface::to_frame(const Point& p) const {
  const Vector v = p - Point{};
  return {mesh::dot(v, frame.u), mesh::dot(v, frame.v), mesh::dot(v, frame.w)};
}

double GridSurface::elevation(double x, double y) const {
  if (box.size().z < kFlat) return box.low.z;
  double elevation = box.low.z;
  double most_inside = -std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : triangles) {
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0.0) continue;
    const double bb = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
    const double bc = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
    const double inside = std::min({bb, bc, 1.0 - bb - bc});
    if (inside <= most_inside) continue;
    most_inside = inside;
    elevation = a.z + bb * (b.z - a.z) + bc * (c.z - a.z);
  }
  return elevation;
}

bool GridSurface::contains(double x, double y) const {
  bool inside = false;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point& a = loop[i];
      const Point& b = loop[(i + 1) % loop.size()];
      if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
  }
  return inside;
}

double GridSurface::distance_to_outline(double x, double y) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Point& a = loop[i];
      const Vector along = loop[(i + 1) % loop.size()] - a;
      const double squared = along.x * along.x + along.y * along.y;
      const double t = squared > 0.0 ? ((x - a.x) * along.x + (y - a.y) * along.y) / squared : 0.0;
      const double s = std::clamp(t, 0.0, 1.0);
      nearest = std::min(nearest, std::hypot(a.x + s * along.x - x, a.y + s * along.y - y));
    }
  }
  return nearest;
}

GridSurface make_grid_surface(const GridSite& site, const RegionGraph& graph, std::span<const std::uint32_t> regions,
                              const Vector& look, double height_m) {
  const auto outline = graph.outline(regions, look);
  GridSurface surface;
  surface.frame = upright_frame(look);
  surface.frame = turned(surface.frame, main_direction(transformed(surface, outline)));
  for (auto& loop : transformed(surface, outline)) {
    if (signed_area(loop) > 0.0 || ends_surface(site, surface, loop, height_m))
      surface.loops.push_back(std::move(loop));
  }
  for (const auto& loop : surface.loops) {
    for (const Point& p : loop) surface.box.add(p);
  }
  for (const std::uint32_t region : regions) {
    for (const std::uint32_t t : site.regions.of(region)) {
      const auto [a, b, c] = mesh::corners(site.faces, t);
      surface.triangles.push_back({surface.to_frame(a), surface.to_frame(b), surface.to_frame(c)});
    }
  }
  return surface;
}

}  // namespace clerestory::lighting
