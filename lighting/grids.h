// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lighting/results.h"
#include "lighting/study.h"
#include "mesh/faces.h"
#include "mesh/rays.h"
#include "mesh/rooms.h"

namespace clerestory::lighting {

/// What sensors are placed in.
struct SensorPlaces {
  const mesh::Faces& faces;
  const mesh::Rays& rays;
  /// [2 a triangle of the shape] whether light, or the outside, can reach that side of it (mesh::reachable_triangles)
  const std::vector<std::uint8_t>& reachable;
  const mesh::Rooms& rooms;
};

/// The sensors of one grid.
struct NamedSensors {
  std::string name;
  Sensors sensors;
};

/// Where the sensors of a request stand, in the model's local coordinates (results add Faces::origin): one grid, or one for each room
/// that light can reach (for each, where it reaches none), named after it.
/// Rooms: their floors. Near-horizontal surfaces: the plane `height_m` above, looking up, whatever the winding; others: `height_m` in
/// front, looking into the room. Of a part or material that has both, the level ones are meant, unless the others have more than twice
/// their area.
/// The cells tile the rectangle about each surface, along its main direction, less the margin: their number along a side is the
/// length by the spacing, rounded, and their size follows. A sensor belongs when its place on the surface lies inside of the outline
/// and the margin away from it; furniture, columns and partitions standing free are not part of the outline. A room that an automatic
/// margin leaves no sensor gets one in the middle. Sensors inside solids are left out and counted. Given points are used as they are;
/// they have cells when they form a lattice. Where the request asks for another direction than the surface's, they stand in the same places.
/// @param notices  receives a sentence on rooms that have no grid
/// Throws InputError when no surface fits the request (naming what there is), or no sensor is left.
std::vector<NamedSensors> place_sensors(const GridRequest& request, const SensorPlaces& places,
                                        std::vector<std::string>& notices);

/// A grid's name in small letters: two that differ by these alone would be one file on some systems.
std::string lower(std::string name);

/// Figures of a grid from its values, errors and daylight factors (if any). A grid of zeros without errors has met any accuracy.
GridMetrics grid_metrics(const GridResult& grid, double accuracy_target);

}  // namespace clerestory::lighting
