// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lighting/receiver.h"
#include "lighting/scene.h"
#include "lighting/sky.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// Across, as seen from the earth [degrees].
inline constexpr double kSunDiameterDeg = 0.533;

/// The direction towards the place of the sun's disc that belongs to (a, b) in the unit square, uniform in solid angle; of a sun without a
/// disc its own.
mesh::Vector sun_direction(const Sun& sun, double a, double b);

/// The normals of a scene's panes, one of those that are parallel.
std::vector<mesh::Vector> pane_normals(const Scene& scene);

/// Illuminance by a sun at a point off the scene's surfaces, were all its light to come from one direction [lux]: straight, through panes
/// by their angle and openings, and as panes mirror it. Exact for a sun without a disc.
double sun_illuminance(const Scene& scene, const Sun& sun, const mesh::Point& at, const Receiver& receiver,
                       const mesh::Vector& towards);

/// The same of the scene's whole sun, or of all suns of a sum of skies: of a disc the mean over a fixed pattern of places, whose penumbras
/// have as many steps.
double sun_illuminance(const Scene& scene, const mesh::Point& at, const Receiver& receiver);

}  // namespace clerestory::lighting
