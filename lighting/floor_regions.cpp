// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>

#include "lighting/sensor_surfaces.h"

namespace clerestory::lighting {

namespace {

using mesh::Point;
using mesh::Vector;

constexpr Vector kUp{0.0, 0.0, 1.0};
/// A room that one can stand in [m].
constexpr double kHeadroom = 1.8;
constexpr double kLeastArea = 2.0;  ///< [m²]
/// Points of a region that are looked at.
constexpr std::uint32_t kSamples = 32;
constexpr std::uint32_t kFewSamples = 8;
/// Headroom over a third is enough: furniture may fill the rest.
constexpr std::uint32_t kHeadroomShare = 3;
/// An edge is one that one falls over when it goes down by this [m]: more than a step, less than a storey.
constexpr double kLeastDrop = 0.3;
/// Tops of tables have such edges all around, or, in niches, in corners and along walls, over a part of the outline; they are then
/// narrow, or there is free space below.
constexpr double kFreeStanding = 0.5;
constexpr double kPartStanding = 0.2;
constexpr double kNarrow = 1.0;  ///< [m]
/// What one falls from nearly all around, however deep, is the top of a block and no gallery.
constexpr double kBlock = 0.9;

enum class Light { kReaches, kDark };

/// Whether a region is a floor to stand on below a roof, in a room that light reaches or in a dark one.
bool is_floor(const GridSite& site, std::uint32_t region, double height_m, Light light) {
  if (!near_horizontal(site, region) || site.regions.area_m2[region] <= 0.0) return false;
  if (site.region_reachable(region, upper_side(site, region)) != (light == Light::kReaches)) return false;
  const mesh::RegionPoints points(site.faces, site.regions, region);
  std::uint32_t roofed = 0;
  std::uint32_t high = 0;
  std::uint32_t solid = 0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const Point above = points.at(i) + site.rays.offset_m() * kUp;
    const double way = site.free_way(above, kUp);
    if (std::isinf(way)) continue;
    ++roofed;
    if (way <= std::max(kHeadroom, height_m)) continue;
    ++high;
    if (light == Light::kDark && inside_solid(site, above + height_m * kUp, kUp)) ++solid;
  }
  return 2 * roofed >= kSamples && kHeadroomShare * high >= kSamples && 2 * solid <= high;
}

/// Whether the sensors' plane goes on over a region that is no floor itself: covered by furniture lower than the sensors.
bool goes_on(const GridSite& site, std::uint32_t region, double height_m) {
  if (!near_horizontal(site, region) || site.regions.area_m2[region] <= 0.0) return false;
  const mesh::RegionPoints points(site.faces, site.regions, region);
  std::uint32_t good = 0;
  for (std::uint32_t i = 0; i < kFewSamples; ++i) {
    const Point place = points.at(i) + std::max(height_m, site.rays.offset_m()) * kUp;
    if (!std::isinf(site.free_way(place, kUp)) && !inside_solid(site, place, kUp)) ++good;
  }
  return 2 * good >= kFewSamples;
}

/// Shares of the outer outline over which one falls [0 … 1].
struct Drops {
  double any = 0.0;
  double shallow = 0.0;  ///< less than a storey
};

Drops drops_around(const GridSite& site, const GridSurface& surface) {
  constexpr double kSpacing = 0.25;
  constexpr double kBeyond = 0.05;
  Drops drops;
  double all = 0.0;
  for (const auto& loop : surface.loops) {
    if (signed_area(loop) <= 0.0) continue;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector along = loop[(i + 1) % loop.size()] - loop[i];
      const double length = mesh::norm(along);
      const Vector outwards = kBeyond * mesh::normalized(Vector{along.y, -along.x, 0.0});
      const int tries = std::clamp(static_cast<int>(length / kSpacing), 1, 64);
      all += length;
      for (int k = 0; k < tries; ++k) {
        const Point edge = loop[i] + ((k + 0.5) / tries) * along + Vector{0.0, 0.0, kBeyond};
        const Point beyond = surface.to_local(edge + outwards);
        if (!site.clear(surface.to_local(edge - outwards), beyond)) continue;
        const double drop = site.free_way(beyond, -kUp) - kBeyond;
        if (drop >= kLeastDrop) drops.any += length / tries;
        if (drop >= kLeastDrop && drop <= kHeadroom) drops.shallow += length / tries;
      }
    }
  }
  return all > 0.0 ? Drops{drops.any / all, drops.shallow / all} : Drops{};
}

/// Whether light reaches a floor less than a man's height below a point of a surface.
bool hollow_below(const GridSite& site, Point point) {
  constexpr int kMostLayers = 8;
  double depth = 0.0;
  for (int layer = 0; layer < kMostLayers && depth < kHeadroom; ++layer) {
    point = point - site.rays.offset_m() * kUp;
    const mesh::Hit hit = site.rays.first_hit({point, -kUp});
    if (!hit.face.valid()) return false;
    depth += hit.distance + site.rays.offset_m();
    if (depth < kHeadroom && site.reaches(hit.triangle, hit.side)) return true;
    point = point - hit.distance * kUp;
  }
  return false;
}

bool is_furniture(const GridSite& site, const GridSurface& surface, std::span<const std::uint32_t> regions) {
  const Drops drops = drops_around(site, surface);
  if (drops.shallow >= kFreeStanding || drops.any >= kBlock) return true;
  if (drops.shallow < kPartStanding) return false;
  if (surface.smaller_width_m() < kNarrow) return true;
  const auto largest = *std::ranges::max_element(regions, {}, [&](std::uint32_t r) { return site.regions.area_m2[r]; });
  const mesh::RegionPoints points(site.faces, site.regions, largest);
  std::uint32_t hollow = 0;
  for (std::uint32_t i = 0; i < kFewSamples; ++i) hollow += hollow_below(site, points.at(i)) ? 1 : 0;
  return 2 * hollow >= kFewSamples;
}

std::vector<GridSurface> rooms_with(Light light, const GridSite& site, const RegionGraph& graph, double height_m) {
  std::vector<std::uint32_t> floors;
  for (std::uint32_t r = 0; r < site.regions.count(); ++r) {
    if (is_floor(site, r, height_m, light)) floors.push_back(r);
  }
  const auto joined = graph.join(floors, {.may_join = [&](std::uint32_t r) { return goes_on(site, r, height_m); },
                                          .side = [&](std::uint32_t r) { return upper_side(site, r); },
                                          .height_m = height_m});
  std::vector<GridSurface> rooms;
  for (const auto& regions : joined) {
    double area = 0.0;
    for (const std::uint32_t r : regions) area += site.regions.area_m2[r];
    if (area < kLeastArea) continue;
    GridSurface surface = make_grid_surface(site, graph, regions, kUp, height_m);
    if (!surface.loops.empty() && !is_furniture(site, surface, regions)) rooms.push_back(std::move(surface));
  }
  return rooms;
}

}  // namespace

std::vector<GridSurface> room_floors(const GridSite& site, const RegionGraph& graph, double height_m) {
  auto rooms = rooms_with(Light::kReaches, site, graph, height_m);
  return rooms.empty() ? rooms_with(Light::kDark, site, graph, height_m) : rooms;
}

}  // namespace clerestory::lighting
