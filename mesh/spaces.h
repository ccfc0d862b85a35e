// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "mesh/rooms.h"

// Private to mesh/.
namespace clerestory::mesh {

/// The columns of a raster that the boundaries of spaces hold; `room` counts the spaces.
/// @param origin  of the local coordinates
std::vector<RoomColumn> space_columns(std::span<const Space> spaces, const Raster& raster, const Vector& origin);

/// The rooms that spaces are: name, floor area (of what lies lowest in each column, in plan), volume (by the divergence theorem; of
/// boundaries that do not close, by their columns) and box.
/// @param columns  those of the spaces
std::vector<Room> stated_rooms(std::span<const Space> spaces, const Raster& raster, std::span<const RoomColumn> columns,
                               const Vector& origin);

}  // namespace clerestory::mesh
