// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/columns.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Number of a cell, or kNoCell.
using CellId = std::int32_t;
inline constexpr CellId kNoCell = -1;

/// For each span the spans of the columns beside it (-x, +x, -y, +y) below the same ceiling: they overlap, and their tops differ by
/// less than a beam's height. Span::kNone where there is none. Looked at just below the ceiling, furniture does not stand in the way,
/// and a door with a lintel above it is as good as a wall.
std::vector<std::array<std::uint32_t, 4>> ceiling_links(const Columns& columns);

/// Cells: what necks of the ceiling's plan cut the free space into, before anything is known of what lies below the lintels.
struct RoomCells {
  std::vector<CellId> of_span;     ///< [spans] kNoCell for those below the open sky, and below nothing
  std::vector<float> clearance_m;  ///< [spans] distance to the nearest wall below the ceiling
  std::size_t count = 0;
};

/// The watershed of the distance to the walls, whose basins are joined where the neck between them is as wide as a wide door or hardly
/// narrower than the basins themselves. Source: [Haumont, Debeir, Sillion 2003], on the spans of columns in place of cubes.
RoomCells room_cells(const Columns& columns, const std::vector<std::array<std::uint32_t, 4>>& links);

}  // namespace clerestory::mesh
