// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lighting/grid_surface.h"

namespace clerestory::lighting {

/// Walls and ceilings of a room as surfaces that sensors stand on, looking into the room. Private to the placing of sensors.
struct RoomBounds {
  std::vector<GridSurface> walls;
  std::vector<GridSurface> ceilings;
};

/// Walls: upright surfaces that reach up to within 0.3 m of the room's top. Ceilings: surfaces that look down 2 m or more above its floor. Both of
/// 1 m² at least, reached by light, opaque.
/// @param passable  [faces] glass and air, which are neither
RoomBounds room_bounds(const GridSite& site, const RegionGraph& graph, std::uint32_t room,
                       std::span<const std::uint8_t> passable);

}  // namespace clerestory::lighting
