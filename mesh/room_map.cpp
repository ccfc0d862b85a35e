// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/room_map.h"

#include <algorithm>
#include <tuple>

namespace clerestory::mesh {

RoomMap::RoomMap(const Raster& raster, std::vector<RoomColumn> columns)
    : raster_(raster), columns_(std::move(columns)) {
  std::ranges::sort(columns_, {},
                    [](const RoomColumn& c) { return std::tuple(c.column, c.kind, c.floor, c.ceiling, c.room); });
  starts_.reserve(raster_.count() + 1);
  std::uint32_t next = 0;
  for (std::uint32_t c = 0; c < raster_.count(); ++c) {
    while (next < columns_.size() && columns_[next].column == c) ++next;
    starts_.push_back(next);
  }
}

const RoomColumn* RoomMap::at(const Point& p, double slack_m) const {
  const auto column = raster_.at(p.x, p.y);
  if (!column) return nullptr;
  for (const RoomColumn& c : of(*column)) {
    if (p.z >= c.floor - slack_m && p.z <= c.ceiling + slack_m) return &c;
  }
  return nullptr;
}

}  // namespace clerestory::mesh
