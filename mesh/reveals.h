// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "mesh/rooms.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Makes niches of the columns that stand in the reveals of panes as high as the room: floor areas end at the inner face of the wall, and
/// not at a pane within it. A reveal is what jambs on one or both sides of a pane make narrower than the room, up to 0.6 m deep.
void set_reveals_apart(const Faces& faces, const Rays& rays, const RoomSearch& search, const Raster& raster,
                       std::vector<RoomColumn>& columns);

}  // namespace clerestory::mesh
