// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lighting/local_pass.h"
#include "lighting/solution.h"
#include "mesh/faces.h"

namespace clerestory::lighting {

/// A hair inside of a cell from one of its corners or edges: light is asked for there, off the edges of faces and on one side of a line [m].
mesh::Point inside_from(const mesh::Point& edge, const mesh::Point& middle);

struct GradingOptions {
  double tolerance = 0.02;    ///< share of the illuminance that interpolation may miss
  double darkest_lux = 0.0;   ///< places darker than this count as if they had it
  std::size_t most = 100000;  ///< triangles: where more would be needed, all sizes grow alike
  bool closely = false;       ///< whether to judge by the middles of triangles too
};

/// How large triangles may be for interpolation between their corners to keep to a tolerance.
struct GradedSizes {
  std::vector<double> longest_m;  ///< [triangles of the mesh that was judged] longest edge there
  bool kept = true;               ///< whether the mesh that was judged keeps to it
};

/// Judges a mesh by the straight light of lamps: what a linear interpolation misses is an eighth of the second derivative along an edge times
/// its length squared, which is how far the light in the middle of the edge is from the mean of its ends [Lischinski, Tampieri, Greenberg
/// 1992]. Light that is known by rays alone, with their noise, is not judged.
/// @param mesh   triangles of one patch have smooth light
/// @param shown  [sides] non-zero for those to judge
/// @param jumps  [faces] non-zero where light itself jumps between patches
GradedSizes graded_sizes(const Solution& solution, const LocalPass& local, const mesh::Triangulation& mesh,
                         std::span<const std::uint8_t> shown, std::span<const std::uint8_t> jumps,
                         const GradingOptions& options);

}  // namespace clerestory::lighting
