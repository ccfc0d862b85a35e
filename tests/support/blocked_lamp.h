// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "mesh/geometry.h"

namespace clerestory::support {

/// A lamp that shines evenly, and what stands before it: the exact light of both, by clipping. An oracle for the shadows of the program,
/// of whose code it uses none.
struct BlockedLamp {
  std::vector<mesh::Point> lamp;  ///< a convex polygon, corners in turn, either way [m]
  double exitance_lm_m2 = 1.0;
  std::vector<std::vector<mesh::Point>> blockers;  ///< convex polygons, corners in turn, either way [m]
};

/// Illuminance of a point in front of the lamp [lux]: the lamp's polygon less each blocker's shadow volume from the point, by Lambert's
/// formula for polygons [Lambert 1760]. Blockers may overlap, touch, and reach the point's own plane; one whose plane holds the point hides nothing.
/// @param normal  unit, of the surface at the point
double exact_illuminance(const BlockedLamp& scene, const mesh::Point& at, const mesh::Vector& normal);

}  // namespace clerestory::support
