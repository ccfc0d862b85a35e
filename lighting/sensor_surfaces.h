// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "lighting/grid_surface.h"

namespace clerestory::lighting {

/// The floor of a room: level regions joined over edges that nothing stands on higher than the sensors, with what low furniture covers.
std::vector<GridSurface> room_floors(const GridSite& site, const RegionGraph& graph, std::uint32_t room,
                                     double height_m);

/// Whether light reaches any part of a room's floor.
bool light_reaches(const GridSite& site, std::uint32_t room);

/// The surfaces of the parts and materials that a name or glob fits.
/// Either their near-horizontal surfaces, where the space above is free up to the sensors, or, where the other ones have more than
/// twice the area, those: on the side that looks into a room.
/// @returns nothing when no name fits, or no surface has room for sensors; `fits` tells which
std::vector<GridSurface> named_surfaces(const GridSite& site, const RegionGraph& graph, const std::string& glob,
                                        double height_m, bool& fits);

/// Leaves out the sensors that lie inside solids, and counts them; gives the others their numbers.
void leave_out_solids(const GridSite& site, Sensors& sensors);

/// A room's name as one that a file can have too, and no other grid has.
/// @param taken  in small letters; the new one is added
std::string grid_name(const std::string& room, std::set<std::string>& taken);

}  // namespace clerestory::lighting
