// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Leaves out the parts whose box lies farther than a distance [m] from that of the largest connected group of parts: the group
/// of most polygons, where parts whose boxes come within a metre of each other are connected.
/// @param notices  receives a sentence for each part left out
void leave_out_far_parts(Soup& soup, double far_away_m, const std::vector<std::string>& part_names,
                         std::vector<std::string>& notices);

/// Shifts the soup so that the largest connected group of parts is centred, to the nearest whole metre: so decimals stay what
/// they were, and a soup that is centred already does not move.
/// @return what was taken off [m]
Vector recentre(Soup& soup);

}  // namespace clerestory::mesh
