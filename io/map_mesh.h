// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "io/map_plan.h"

namespace clerestory::io {

/// Values on quadrilaterals, bilinear in each and continuous where they share nodes.
struct MapMesh {
  std::vector<MapPoint> nodes;  ///< [m]
  std::vector<float> values;    ///< of the nodes
  std::vector<std::array<std::uint32_t, 4>> quads;
};

/// Cuts each cell into four round its sensor. The middle of an edge has the mean of its two cells, the border goes on from the
/// inside by half a cell, and a corner has the mean of what the cells that meet there expect. On a regular grid that is the
/// bilinear interpolation between sensors, on any other it stays continuous, and linear fields are kept. Nothing is mixed
/// across zones, and no value leaves the range of the sensors'.
MapMesh interpolate(const MapPlan& plan, std::span<const float> values);

/// The lines on which a mesh has the given value, each a chain of points [m]; a closed line repeats its first point.
/// Crossings are exact on the edges of the mesh, straight within its quadrilaterals (marching squares; a saddle is resolved
/// by its centre).
std::vector<std::vector<MapPoint>> isolines(const MapMesh& mesh, double value);

}  // namespace clerestory::io
