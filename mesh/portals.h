// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "mesh/room_cells.h"

// Private to mesh/.
namespace clerestory::mesh {

/// An opening through which one piece of the free space goes on into another.
struct Portal {
  CellId a = kNoCell;  ///< below b
  CellId b = kNoCell;
  double width_m = 0.0;
  double border_m = 0.0;  ///< along the sides of the columns, which a slanted opening has more of
  double area_m2 = 0.0;
  Box box;  ///< in which it lies [m, local]
};

/// Portals between spans of different numbers that lie side by side and overlap by at least a height, each connected opening one.
/// Spans that have no number (kNoCell) have no portals, nor have pairs whose lower number is not below `limit`.
std::vector<Portal> find_portals(const Columns& columns, const std::vector<CellId>& of_span, float least_overlap_m,
                                 CellId limit);

}  // namespace clerestory::mesh
