// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/grid_site.h"

#include <algorithm>
#include <limits>

namespace clerestory::lighting {

namespace {

constexpr std::uint32_t kDirections = 64;
/// After so many directions without a sign of a solid, the position is free.
constexpr std::uint32_t kFirstDirections = 16;
/// Walls and furniture are thinner than this, rooms are wider [m].
constexpr double kSolidFreeWay = 0.75;
/// Positions this close to a surface count as lying on it [m].
constexpr double kOnSurface = 1e-3;

/// What the rays from one position met.
struct Surroundings {
  std::uint32_t rays = 0;
  std::uint32_t escaped = 0;
  std::uint32_t reachable = 0;
  double way_m = 0.0;  ///< sum
};

void look(const GridSite& site, const mesh::Point& from, std::uint32_t first, std::uint32_t last, Surroundings& seen) {
  for (std::uint32_t i = first; i < last; ++i) {
    const mesh::Hit hit =
        site.rays.first_hit({from, mesh::sphere_direction(mesh::spread(i, 0, 0), mesh::spread(i, 1, 0))});
    ++seen.rays;
    if (!hit.face.valid()) {
      ++seen.escaped;
      continue;
    }
    seen.way_m += hit.distance;
    if (site.reaches(hit.triangle, hit.side)) ++seen.reachable;
  }
}

bool looks_solid(const GridSite& site, const mesh::Point& from) {
  Surroundings seen;
  look(site, from, 0, kFirstDirections, seen);
  if (4 * (seen.reachable + seen.escaped) >= 3 * seen.rays) return false;
  look(site, from, kFirstDirections, kDirections, seen);
  // One ray may slip through an edge.
  if (seen.escaped > 1 || 2 * seen.reachable > seen.rays) return false;
  return seen.way_m < kSolidFreeWay * (seen.rays - seen.escaped);
}

}  // namespace

GridSite::GridSite(const SensorPlaces& places)
    : faces(places.faces),
      rays(places.rays),
      rooms(places.rooms),
      regions(mesh::number_regions(places.faces, places.rooms.floor_of)),
      reachable(places.reachable) {}

double GridSite::free_way(const mesh::Point& from, const mesh::Vector& direction) const {
  const mesh::Hit hit = rays.first_hit({from, direction});
  return hit.face.valid() ? hit.distance : std::numeric_limits<double>::infinity();
}

bool GridSite::clear(const mesh::Point& from, const mesh::Point& to) const {
  const mesh::Hit hit = rays.first_hit({from, to - from});
  return !hit.face.valid() || hit.distance > 1.0;
}

bool inside_solid(const GridSite& site, const mesh::Point& position, const mesh::Vector& normal) {
  const double lift = std::max(kOnSurface, site.rays.offset_m());
  return looks_solid(site, position + lift * normal) && looks_solid(site, position + site.rays.offset_m() * normal);
}

}  // namespace clerestory::lighting
