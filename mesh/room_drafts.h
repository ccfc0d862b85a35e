// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/room_cells.h"

// Private to mesh/.
namespace clerestory::mesh {

/// A room before it is measured.
struct RoomDraft {
  double enclosed_share = 0.0;  ///< of its border below the ceiling that walls stand on [0 … 1]
  float clearance_m = 0.0F;     ///< from the place that lies farthest from the walls
};

/// The free space divided into rooms and what is none: the outside, the insides of walls and cupboards, what is below tables,
/// in doorways and in window niches.
struct RoomDrafts {
  Columns columns;              ///< cut where a room ends at a stairwell or at the open sky
  std::vector<CellId> of_span;  ///< [spans] number of the room, or kNoCell
  std::vector<RoomDraft> rooms;
};

/// Finds rooms: cells joined over openings too wide for doors, in which one can stand and turn.
RoomDrafts draft_rooms(const Faces& faces);

}  // namespace clerestory::mesh
