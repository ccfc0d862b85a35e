// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "mesh/room_drafts.h"
#include "mesh/room_map.h"

// Private to mesh/.
namespace clerestory::mesh {

/// The columns of the drafted rooms with their floors. What one would fall from on most sides onto a lower floor of the same room is
/// furniture, and the column goes down to that floor; galleries, from which one falls a storey, are floors. Columns of a room over each
/// other (a gallery, and the hall below it) stay apart, a shelf and what is below it become one.
std::vector<RoomColumn> room_columns(const RoomDrafts& drafts);

}  // namespace clerestory::mesh
