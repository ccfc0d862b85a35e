// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/planar.h"
#include "mesh/triangulate.h"

// Private to mesh/.
namespace clerestory::mesh {

/// A face's triangulation with lines in it: its components are patches.
struct LinedMesh {
  PlanarMesh mesh;
  std::vector<std::uint32_t> region_of_patch;  ///< [patches] the component without the lines
  std::size_t merged = 0;                      ///< lines of which nothing is new
  std::size_t left_out = 0;                    ///< lines, the lightest, with which the mesh would be degenerate
  double length_m = 0.0;                       ///< of what is new
};

/// Puts lines, the weightiest first, into a triangulation as constraints, by a LineArrangement.
/// @param coarse    as triangulate_inside() gives it
/// @param distance  within which lines are one [m]
LinedMesh with_lines(PlanarMesh coarse, std::span<const std::array<Point2, 2>> lines, double distance);

}  // namespace clerestory::mesh
