// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/room_bounds.h"

#include <cmath>
#include <optional>

#include "mesh/rooms.h"

namespace clerestory::lighting {

namespace {

using mesh::Point;
using mesh::Side;
using mesh::Vector;

constexpr double kLeastAreaM2 = 1.0;
constexpr double kBelowTopM = 0.3;
constexpr double kHeadroomM = 2.0;
constexpr double kUpright = 0.26;   ///< within 15° of the upright [|cos|]
constexpr double kDownwards = 0.5;  ///< within 60° of straight down [cos]
/// Points of a region that are looked at.
constexpr std::uint32_t kSamples = 8;

bool looks_into(const GridSite& site, std::uint32_t region, const Vector& look, std::uint32_t room) {
  const mesh::RegionPoints points(site.faces, site.regions, region);
  std::uint32_t inside = 0;
  for (std::uint32_t i = 0; i < kSamples; ++i)
    if (mesh::room_before(site.rooms, site.rays, points.at(i), look) == room) ++inside;
  return 2 * inside > kSamples;
}

mesh::Box box_of(const GridSite& site, std::uint32_t region) {
  mesh::Box box;
  for (const std::uint32_t t : site.regions.of(region)) {
    for (const Point& p : mesh::corners(site.faces, t)) box.add(p);
  }
  return box;
}

/// The side of a region that bounds a room, as a wall or as a ceiling.
struct Bound {
  Side side = Side::kFront;
  bool ceiling = false;
};

std::optional<Bound> bound_of(const GridSite& site, std::uint32_t region, std::uint32_t room) {
  const mesh::Box& space = site.rooms.rooms[room].box;
  const mesh::Box box = box_of(site, region);
  for (const Side side : {Side::kFront, Side::kBack}) {
    const Vector look = mesh::side_normal(site.faces, site.regions.face[region], side);
    const bool wall = std::abs(look.z) < kUpright && box.high.z > space.high.z - kBelowTopM;
    const bool ceiling = look.z < -kDownwards && box.low.z > space.low.z + kHeadroomM;
    if (!(wall || ceiling) || !site.region_reachable(region, side) || !looks_into(site, region, look, room)) continue;
    return Bound{side, ceiling};
  }
  return std::nullopt;
}

}  // namespace

RoomBounds room_bounds(const GridSite& site, const RegionGraph& graph, std::uint32_t room,
                       std::span<const std::uint8_t> passable) {
  RoomBounds bounds;
  for (std::uint32_t r = 0; r < site.regions.count(); ++r) {
    if (site.regions.area_m2[r] < kLeastAreaM2 || passable[site.regions.face[r].index()] != 0) continue;
    const auto bound = bound_of(site, r, room);
    if (!bound) continue;
    const Vector look = mesh::side_normal(site.faces, site.regions.face[r], bound->side);
    GridSurface surface = make_grid_surface(site, graph, std::span(&r, 1), look, 0.0);
    if (!surface.loops.empty()) (bound->ceiling ? bounds.ceilings : bounds.walls).push_back(std::move(surface));
  }
  return bounds;
}

}  // namespace clerestory::lighting
