// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/columns.h"
#include "mesh/geometry.h"

namespace clerestory::mesh {

/// A column of a room, from floor to ceiling; furniture in it does not count.
struct RoomColumn {
  std::uint32_t column = 0;
  std::uint32_t room = 0;
  float floor = 0.0F;    ///< [m, local]
  float ceiling = 0.0F;  ///< [m, local]
  /// Below this, furniture or a sill may fill the column; above, it is free up to the ceiling [m, local].
  float free_from = 0.0F;
  enum class Kind : std::uint8_t {
    kWhole,
    kFloorless,  ///< above a stairwell: part of the volume, not of the floor
    kNiche,      ///< a window niche, what is below a table …: part of neither
  };
  Kind kind = Kind::kWhole;
};

/// Which room is where. The columns of raster column c are columns[starts[c]] … columns[starts[c+1]-1], from below.
class RoomMap {
 public:
  RoomMap() = default;
  /// @param columns  in any order
  RoomMap(const Raster& raster, std::vector<RoomColumn> columns);

  [[nodiscard]] const Raster& raster() const { return raster_; }
  [[nodiscard]] const std::vector<RoomColumn>& columns() const { return columns_; }
  [[nodiscard]] std::span<const RoomColumn> of(std::uint32_t column) const {
    return std::span(columns_).subspan(starts_[column], starts_[column + 1] - starts_[column]);
  }
  /// The column of a room at a place [m, local], between floor and ceiling to within a slack [m]; null where there is none, such as in
  /// cells that a wall touches.
  [[nodiscard]] const RoomColumn* at(const Point& p, double slack_m = 0.0) const;

 private:
  Raster raster_;
  std::vector<RoomColumn> columns_;
  std::vector<std::uint32_t> starts_{0};
};

}  // namespace clerestory::mesh
