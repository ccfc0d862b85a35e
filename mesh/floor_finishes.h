// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/room_parts.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Lines along which the floor changes its material, as from the tiles of a kitchen to the boards of a living room; shut where something
/// of the height of a counter stands along them (0.8 m and more). A floor below furniture counts as well.
PartingLines floor_finish_lines(const Faces& faces, const Columns& columns, const RoomCells& cells);

}  // namespace clerestory::mesh
