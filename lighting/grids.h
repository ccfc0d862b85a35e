// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/results.h"
#include "lighting/study.h"
#include "mesh/faces.h"
#include "mesh/rays.h"

namespace clerestory::lighting {

/// Where the sensors of a request stand, in the model's local coordinates (results add Faces::origin).
/// Near-horizontal surfaces: the plane `height_m` above, looking up, whatever the winding; others: `height_m` in front, looking into
/// the room. The cells tile the request's surfaces less the margin with the spacing asked; sensors inside solids are left out
/// and counted.
/// @param reachable  [2 a face] whether light, or the outside, can reach that face side (mesh::reachable_sides)
/// Throws InputError when no surface fits the request (naming what there is), or no sensor is left.
Sensors place_sensors(const GridRequest& request, const mesh::Faces& faces, const mesh::Rays& rays,
                      const std::vector<std::uint8_t>& reachable);

/// Figures of a grid from its values, errors and daylight factors (if any).
GridMetrics grid_metrics(const GridResult& grid, double accuracy_target);

}  // namespace clerestory::lighting
