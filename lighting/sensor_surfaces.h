// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "lighting/grid_surface.h"

namespace clerestory::lighting {

/// The floors of rooms: level regions that light can reach (where it reaches none, the dark ones), with a roof and at
/// least 1.8 m of free height, joined over edges that nothing stands on higher than the sensors, of 2 m² and more; but not the tops
/// of tables, beds and counters, over whose edges one falls on a lower floor.
std::vector<GridSurface> room_floors(const GridSite& site, const RegionGraph& graph, double height_m);

/// The surfaces of the parts and materials that a name or glob fits.
/// Either their near-horizontal surfaces, where the space above is free up to the sensors, or, where the other ones have more than
/// twice the area, those: on the side that looks into a room.
/// @returns nothing when no name fits, or no surface has room for sensors; `fits` tells which
std::vector<GridSurface> named_surfaces(const GridSite& site, const RegionGraph& graph, const std::string& glob,
                                        double height_m, bool& fits);

}  // namespace clerestory::lighting
