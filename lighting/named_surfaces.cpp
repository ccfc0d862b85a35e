// SPDX-License-Identifier: GPL-3.0-or-later
#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lighting/sensor_surfaces.h"

namespace clerestory::lighting {

namespace {

using mesh::Point;
using mesh::Side;
using mesh::Vector;

constexpr Vector kUp{0.0, 0.0, 1.0};
constexpr std::uint32_t kSamples = 16;
/// Upright surfaces are meant where they have more than this many times the area of the level ones.
constexpr double kUprightExcess = 2.0;
/// Surfaces closer than this lie on each other [m].
constexpr double kTouching = 1e-3;

bool fits_name(const std::string& glob, const std::string& name) { return fnmatch(glob.c_str(), name.c_str(), 0) == 0; }

std::vector<std::uint8_t> fitting_regions(const GridSite& site, const std::string& glob, bool& fits) {
  const auto matches = [&](const std::vector<std::string>& names) {
    std::vector<bool> result;
    for (const std::string& name : names) result.push_back(fits_name(glob, name));
    return result;
  };
  const auto parts = matches(site.faces.part_names);
  const auto materials = matches(site.faces.material_names);
  std::vector<std::uint8_t> result(site.regions.count(), 0);
  for (std::size_t r = 0; r < result.size(); ++r) {
    const mesh::Face& face = site.faces.faces[site.regions.face[r].index()];
    const bool by_part = face.part.valid() && parts[face.part.index()];
    const bool by_material = (face.material.valid() && materials[face.material.index()]) ||
                             (face.back_material.valid() && materials[face.back_material.index()]);
    if (by_part || by_material) result[r] = 1;
    if (by_part || by_material) fits = true;
  }
  return result;
}

/// What the space before one side of a region is like, at its sensors.
struct Space {
  std::uint32_t free = 0;      ///< samples with nothing between the surface and the sensor, which is in no solid
  std::uint32_t roofed = 0;    ///< of them, those with something overhead
  std::uint32_t escaping = 0;  ///< of one ray a free sample, those that leave the model
};

Space look_at(const GridSite& site, std::uint32_t region, const Vector& look, double height_m) {
  Space space;
  const mesh::RegionPoints points(site.faces, site.regions, region);
  const mesh::Frame frame = mesh::frame_around(look);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const Point surface = points.at(i) + site.rays.offset_m() * look;
    if (site.free_way(surface, look) <= std::max(height_m, kTouching)) continue;
    const Point sensor = surface + height_m * look;
    if (inside_solid(site, sensor, look)) continue;
    ++space.free;
    if (!std::isinf(site.free_way(sensor, kUp))) ++space.roofed;
    const Vector way = mesh::cosine_direction(frame, mesh::spread(i, 3, region), mesh::spread(i, 4, region));
    if (std::isinf(site.free_way(sensor, way))) ++space.escaping;
  }
  return space;
}

/// The regions of one kind that have room for sensors, and the sides for them.
struct Choice {
  std::vector<std::uint32_t> regions;
  std::vector<Side> side;  ///< [all regions]
  double area_m2 = 0.0;

  void add(const GridSite& site, std::uint32_t region) {
    regions.push_back(region);
    area_m2 += site.regions.area_m2[region];
  }
};

Choice level_surfaces(const GridSite& site, const std::vector<std::uint8_t>& fitting, double height_m) {
  Choice level;
  level.side.resize(fitting.size(), Side::kFront);
  for (std::uint32_t r = 0; r < fitting.size(); ++r) {
    if (fitting[r] == 0 || !near_horizontal(site, r)) continue;
    level.side[r] = upper_side(site, r);
    // A quarter is enough: furniture may stand on the rest.
    if (site.regions.area_m2[r] > 0.0 && 4 * look_at(site, r, kUp, height_m).free >= kSamples) level.add(site, r);
  }
  return level;
}

/// Which side of an upright region looks into a room; none where neither has room for sensors.
struct Facing {
  Side side = Side::kFront;
  bool indoors = false;
};
std::optional<Facing> facing(const GridSite& site, std::uint32_t region, double height_m) {
  std::optional<Facing> best;
  double best_rank = -1.0;
  for (const Side side : {Side::kFront, Side::kBack}) {
    const Space space = look_at(site, region, look_of(site, region, side), height_m);
    if (4 * space.free < kSamples) continue;
    const double free = space.free;
    const bool indoors = 2 * space.roofed > space.free;
    const double reachable = site.region_reachable(region, side) ? 2.0 : 0.0;
    const double rank = (indoors ? 4.0 : 0.0) + reachable + (1.0 - space.escaping / free);
    if (rank <= best_rank) continue;
    best_rank = rank;
    best = Facing{side, indoors};
  }
  return best;
}

Choice upright_surfaces(const GridSite& site, const std::vector<std::uint8_t>& fitting, double height_m) {
  Choice indoors;
  Choice all;
  all.side.resize(fitting.size(), Side::kFront);
  for (std::uint32_t r = 0; r < fitting.size(); ++r) {
    if (fitting[r] == 0 || near_horizontal(site, r) || site.regions.area_m2[r] <= 0.0) continue;
    const auto found = facing(site, r, height_m);
    if (!found) continue;
    all.side[r] = found->side;
    all.add(site, r);
    if (found->indoors) indoors.add(site, r);
  }
  if (indoors.regions.empty()) return all;
  indoors.side = std::move(all.side);
  return indoors;
}

}  // namespace

std::vector<GridSurface> named_surfaces(const GridSite& site, const RegionGraph& graph, const std::string& glob,
                                        double height_m, bool& fits) {
  const auto fitting = fitting_regions(site, glob, fits);
  const Choice level = level_surfaces(site, fitting, height_m);
  const Choice upright = upright_surfaces(site, fitting, height_m);
  const bool use_upright = upright.area_m2 > kUprightExcess * level.area_m2;
  const Choice& chosen = use_upright ? upright : level;

  const auto may_join = [&](std::uint32_t r) {
    if (use_upright || !near_horizontal(site, r) || site.regions.area_m2[r] <= 0.0) return false;
    // Below furniture a floor goes on, whosever polygon the clean-up kept of the two that lie there.
    const bool hidden = site.floor_room(r) != mesh::kNoRoom && !site.region_reachable(r, upper_side(site, r));
    if (fitting[r] == 0 && !hidden) return false;
    const mesh::RegionPoints points(site.faces, site.regions, r);
    return !inside_solid(site, points.at(0) + std::max(height_m, site.rays.offset_m()) * kUp, kUp);
  };
  const auto joined = graph.join(
      chosen.regions, {.may_join = may_join,
                       .side = [&](std::uint32_t r) { return use_upright ? chosen.side[r] : upper_side(site, r); },
                       .height_m = height_m});
  std::vector<GridSurface> surfaces;
  for (const auto& regions : joined) {
    const Vector look = look_of(site, regions.front(), chosen.side[regions.front()]);
    GridSurface surface = make_grid_surface(site, graph, regions, look, height_m);
    if (!surface.loops.empty()) surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

}  // namespace clerestory::lighting
