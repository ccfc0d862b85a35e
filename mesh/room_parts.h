// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/room_cells.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Below this height nobody stands [m].
inline constexpr float kHeadroom = 1.8F;
/// The least room: what one can stand on [m²], and half of its width; walls and cupboards are narrower [m].
inline constexpr double kLeastRoom = 0.8;
inline constexpr float kLeastHalfWidth = 0.3F;

/// Lines along which cells may be parted, between spans of one cell that lie side by side: bit 0 of a span is for its neighbour at +x,
/// bit 1 for that at +y.
struct PartingLines {
  std::vector<std::uint8_t> open;  ///< [spans] where one may pass
  std::vector<std::uint8_t> shut;  ///< [spans] where something stands
  /// [spans] what the lines tell apart, such as floors: parts of which most is the same are one part. Empty: nothing.
  std::vector<std::uint32_t> label;
  /// [spans] non-zero where something stands, which makes no room of its own. Empty: nowhere.
  std::vector<std::uint8_t> furnished;

  explicit PartingLines(std::size_t spans) : open(spans, 0), shut(spans, 0) {}
};

/// The span of the same cell in the column beside one at +x (0) or +y (1), that which shares most height with it; Span::kNone where there
/// is none.
std::uint32_t beside_in_cell(const Columns& columns, const std::vector<CellId>& of_span, std::uint32_t span,
                             std::size_t axis);

/// Parts cells along lines. Two parts stay apart when each could be a room, and when walls, which have one part on either side, and what
/// stands on the lines make up at least half of their border: an opening is the smaller part of a wall. The largest part keeps
/// the number of the cell.
void part_cells(const Columns& columns, const PartingLines& lines, RoomCells& cells);

}  // namespace clerestory::mesh
