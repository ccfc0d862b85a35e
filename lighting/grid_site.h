// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/grids.h"
#include "mesh/faces.h"
#include "mesh/rays.h"
#include "mesh/regions.h"

namespace clerestory::lighting {

/// What sensors are placed in. Private to the placing of sensors.
struct GridSite {
  const mesh::Faces& faces;
  const mesh::Rays& rays;
  const mesh::Rooms& rooms;
  mesh::Regions regions;                       ///< divided where a floor goes on from room to room
  const std::vector<std::uint8_t>& reachable;  ///< [2 a triangle of the shape] as mesh::reachable_triangles

  explicit GridSite(const SensorPlaces& places);

  /// The room whose floor a region is, or mesh::kNoRoom.
  [[nodiscard]] std::uint32_t floor_room(std::uint32_t region) const {
    const auto triangles = regions.of(region);
    return triangles.empty() ? mesh::kNoRoom : rooms.floor_of[triangles.front()];
  }

  [[nodiscard]] bool reaches(std::uint32_t triangle, mesh::Side side) const {
    return reachable[2 * std::size_t{triangle} + static_cast<std::size_t>(side)] != 0;
  }
  [[nodiscard]] bool region_reachable(std::uint32_t region, mesh::Side side) const {
    const auto triangles = regions.of(region);
    return !triangles.empty() && reaches(triangles.front(), side);
  }
  /// Distance to the first face along a unit direction, infinite when the ray leaves the model [m].
  [[nodiscard]] double free_way(const mesh::Point& from, const mesh::Vector& direction) const;
  /// True when no face, glazing included, stands between two points.
  [[nodiscard]] bool clear(const mesh::Point& from, const mesh::Point& to) const;
};

/// Whether a sensor position lies inside a solid: around it no more than half of what rays meet can be reached by light, none
/// escapes, and the mean way to the first surface is less than 0.75 m. A dark room is therefore not a solid. The winding does not
/// count: few models keep to one. A position within 1 mm of a surface is judged from its open side.
bool inside_solid(const GridSite& site, const mesh::Point& position, const mesh::Vector& normal);

}  // namespace clerestory::lighting
