// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "lighting/light_paths.h"
#include "lighting/links.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// A surface that a ray from a receiver ends on, with the form factor that the ray stands for.
struct SeenSurface {
  /// The deepest that held the place when the ray was traced; invalid where the surface has no elements.
  mesh::ElementId node;
  mesh::Point at;
  float factor = 0.0F;
};

inline SeenSurface seen_surface(const Solution& solution, const SurfacePoint& point, float factor) {
  return {solution.tree().find(point.side, point.region, point.at), point.at, factor};
}

/// The illuminance of the receiver by what its rays end on, as the radiosities of a solution stand [lux].
double illuminance_by(const Solution& solution, std::span<const SeenSurface> seen);

/// Links of one receiver to what its rays end on, one a source element, in the order of their ids. Where on the source the rays
/// end, makes the link follow the line of its radiosity.
/// @param slope  of the receiver's illuminance by all of it, per unit of that illuminance [1/m]; its value is not used
std::vector<Link> links_to_seen(const Solution& solution, mesh::ElementId receiver, std::span<const SeenSurface> seen,
                                const LinearValue& slope);

}  // namespace clerestory::lighting
