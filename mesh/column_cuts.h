// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/room_cells.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Divides a span into one below and one above a height.
struct ColumnCut {
  std::uint32_t span = 0;
  float at = 0.0F;      ///< [m]
  bool stairs = false;  ///< Span::stairs of the lower part
};

/// The columns with the given spans divided. @param old_span  receives for each new span the one that it comes from
Columns cut_columns(const Columns& columns, const std::vector<ColumnCut>& cuts, std::vector<std::uint32_t>& old_span);

/// Yards that walls enclose on all sides below the open sky, cut at the height of these walls: rooms that lack a ceiling.
std::vector<ColumnCut> roofless_rooms(const Columns& columns);

/// Cells whose floor has a void, cut at the level of that floor: stairwells, which are narrow, and wider voids that are a small part of
/// their cell. Where most of a cell is hall and the rest a gallery, it stays whole.
std::vector<ColumnCut> voids(const Columns& columns, const RoomCells& cells);

}  // namespace clerestory::mesh
