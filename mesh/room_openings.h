// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "mesh/room_drafts.h"
#include "mesh/rooms.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Holes of the rooms: where free space goes on to another room or to the outside, straight or by way of space that is no room.
/// @param room_of_span  [spans of the columns] kNoCell for those of no room
/// @param niches        receives the columns of space that goes on to one room and to nothing else
std::vector<std::vector<RoomOpening>> find_holes(const Columns& columns, const std::vector<CellId>& room_of_span,
                                                 std::size_t room_count, std::vector<RoomColumn>& niches);

/// Adds glazing and air polygons to the rooms that they are openings of.
void add_panes(const Faces& faces, const Rays& rays, const RoomSearch& search, Rooms& rooms);

}  // namespace clerestory::mesh
