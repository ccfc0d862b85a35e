// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "mesh/rooms.h"

// Private to mesh/.
namespace clerestory::mesh {

/// The room whose floor the upper side of each triangle of the shape is, or kNoRoom.
std::vector<std::uint32_t> floor_triangles(const Faces& faces, const Rays& rays, const RoomMap& map);

/// Fills floor area, volume and box of rooms that are not stated, from their columns and floor triangles.
void measure_rooms(const Faces& faces, const Rays& rays, const RoomMap& map, const std::vector<std::uint32_t>& floor_of,
                   std::vector<Room>& rooms);

}  // namespace clerestory::mesh
