// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "mesh/rooms.h"

namespace clerestory::io {

/// Rooms as a JSON array, in the words of summary.json: name, floor_area_m2, volume_m3, closed, source, openings.
/// @param rooms  in model coordinates
std::string rooms_json(const std::vector<mesh::Room>& rooms);

}  // namespace clerestory::io
