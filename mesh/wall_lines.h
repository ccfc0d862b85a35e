// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/room_parts.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Lines from the end of one wall to the end of another one that stands in its direction: openings as high as the room that are wider than
/// the rooms are deep, which the watershed cannot see (a hall along a living room). Ends of walls have the cell on both of their sides
/// for 0.3 m; directions are those in which most walls stand.
PartingLines wall_lines(const Faces& faces, const Columns& columns, const RoomCells& cells);

}  // namespace clerestory::mesh
