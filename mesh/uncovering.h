// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/critical_surfaces.h"
#include "mesh/geometry.h"

// Private to mesh/.
namespace clerestory::mesh {

/// A line of light in a critical surface.
struct Sight {
  Point receiver;  ///< where it ends
  Point occluder;  ///< where it touches the occluder
  /// From there to the source [m]; infinite for the sun and for the sky beyond what stands outdoors.
  double source_m = 0.0;
};

/// The jump, where a receiver crosses a critical surface of order k = 1 or 2, of the k-th derivative across its trace of the projected solid angle
/// that is seen of the source [sr/m^k]: of order 1 the angle that both edges have in common, as they part at one go; of order 2 what is
/// seen between the edges of the corner, as its square. 0 for order 0.
/// @param normal  unit, of the receiver, on either side
double uncovering(const Wedge& wedge, const Sight& sight, const Vector& normal);

}  // namespace clerestory::mesh
