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
  SurfacePoint point;
  float factor = 0.0F;
};

/// Links of one receiver to what its rays end on, one a source element, in the order of their ids. Where on the source the rays
/// end, makes the link follow the line of its radiosity.
/// @param slope  of the receiver's illuminance by all of it, per unit of that illuminance [1/m]; its value is not used
std::vector<Link> links_to_seen(const Solution& solution, mesh::ElementId receiver, std::span<const SeenSurface> seen,
                                const LinearValue& slope);

}  // namespace clerestory::lighting
