// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "mesh/discontinuity_lines.h"
#include "mesh/geometry.h"
#include "mesh/ids.h"

namespace clerestory::mesh {

/// Which lines of discontinuity a mesh takes in.
struct LineSelection {
  /// By order of the line (0, 1, 2).
  using Counts = std::array<std::size_t, 3>;

  std::vector<std::uint32_t> kept;  ///< indices of lines, the weightiest first
  Counts found{};
  Counts kept_count{};
  std::size_t merged = 0;         ///< they run along a weightier line of their face wholly
  std::size_t light = 0;          ///< what an interpolation across them misses is within the tolerance
  std::size_t over_cap = 0;       ///< left out for the number of lines of their face, or of all faces
  std::vector<FaceId> cap_faces;  ///< where that was so, ascending
};

struct SelectionOptions {
  std::size_t most_per_face = 100;
  std::size_t most = std::numeric_limits<std::size_t>::max();  ///< on all faces together
  double distance_m = 1e-3;                                    ///< lines closer to each other are one
};

/// A line as the selection weighs it.
struct WeighedLine {
  Vector across;  ///< unit, in the plane of the face and at right angles to the line
  /// Size of the elements across the line, were it and the others not there [m].
  double size_m = 0.0;
  /// What an interpolation over elements of a size [m] misses at the line, in units of what it may miss; grows with the size.
  std::function<double(double)> missed;
};

/// Keeps the lines across which an interpolation would miss more than it may, the weightiest first. A kept line cuts elements: those that
/// come after it are weighed by the size that elements have between the kept lines on either side of them.
/// @param weighed  [lines]
LineSelection select_lines(std::span<const DiscontinuityLine> lines, std::span<const WeighedLine> weighed,
                           const SelectionOptions& options = {});

}  // namespace clerestory::mesh
