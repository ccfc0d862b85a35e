// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>

#include "lighting/sensor_surfaces.h"

namespace clerestory::lighting {

namespace {

using mesh::Point;
using mesh::Vector;

constexpr Vector kUp{0.0, 0.0, 1.0};
/// Points of a region that are looked at.
constexpr std::uint32_t kSamples = 8;
/// Smaller pieces of a floor are left out where a room has larger ones [m²].
constexpr double kLeastArea = 0.5;

/// The level regions that the floor of a room consists of.
std::vector<std::uint32_t> floor_of(const GridSite& site, std::uint32_t room) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t r = 0; r < site.regions.count(); ++r) {
    if (site.floor_room(r) == room && near_horizontal(site, r) && site.regions.area_m2[r] > 0.0) found.push_back(r);
  }
  return found;
}

/// Whether the sensors' plane goes on over a region of the floor that light does not reach: covered by furniture lower than the sensors.
bool goes_on(const GridSite& site, std::uint32_t region, std::uint32_t room, double height_m) {
  if (site.floor_room(region) != room || !near_horizontal(site, region)) return false;
  if (site.regions.area_m2[region] <= 0.0) return false;
  const mesh::RegionPoints points(site.faces, site.regions, region);
  std::uint32_t good = 0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const Point place = points.at(i) + std::max(height_m, site.rays.offset_m()) * kUp;
    if (mesh::room_at(site.rooms, site.rays, place) == room && !inside_solid(site, place, kUp)) ++good;
  }
  return 2 * good >= kSamples;
}

double area_of(const GridSite& site, const std::vector<std::uint32_t>& regions) {
  double area = 0.0;
  for (const std::uint32_t r : regions) area += site.regions.area_m2[r];
  return area;
}

}  // namespace

bool light_reaches(const GridSite& site, std::uint32_t room) {
  return std::ranges::any_of(floor_of(site, room),
                             [&](std::uint32_t r) { return site.region_reachable(r, upper_side(site, r)); });
}

std::vector<GridSurface> room_floors(const GridSite& site, const RegionGraph& graph, std::uint32_t room,
                                     double height_m) {
  auto floors = floor_of(site, room);
  // In a lit room what light does not reach lies below furniture.
  const auto lit = [&](std::uint32_t r) { return site.region_reachable(r, upper_side(site, r)); };
  if (std::ranges::any_of(floors, lit)) std::erase_if(floors, std::not_fn(lit));
  auto joined = graph.join(floors, {.may_join = [&](std::uint32_t r) { return goes_on(site, r, room, height_m); },
                                    .side = [&](std::uint32_t r) { return upper_side(site, r); },
                                    .height_m = height_m});
  const auto small = [&](const auto& regions) { return area_of(site, regions) < kLeastArea; };
  if (!std::ranges::all_of(joined, small)) std::erase_if(joined, small);
  std::vector<GridSurface> surfaces;
  for (const auto& regions : joined) {
    GridSurface surface = make_grid_surface(site, graph, regions, kUp, height_m);
    if (!surface.loops.empty()) surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

}  // namespace clerestory::lighting
