// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/planar.h"

// Private to mesh/.
namespace clerestory::mesh {

/// The ends of a segment in space [m].
using Ends = std::array<Point, 2>;

/// A part of a plane in space, within closed, directed boundaries.
struct PlanarRegion {
  PlaneCoordinates plane;
  std::vector<Ends> edges;
  PlanarOutline outline;  ///< of the edges, in the plane

  PlanarRegion(const PlaneCoordinates& in_plane, std::vector<Ends> boundary);
};

/// The stretches of a segment in the region's plane that lie inside it, longer than the tolerance and not along its boundary [m].
std::vector<Ends> stretches_inside(const PlanarRegion& region, const Ends& segment, double tolerance);

/// The stretches along which two regions cross: of the line in which their planes meet, inside both, longer than the tolerance [m].
std::vector<Ends> crossing_stretches(const PlanarRegion& f, const PlanarRegion& g, double tolerance);

}  // namespace clerestory::mesh
