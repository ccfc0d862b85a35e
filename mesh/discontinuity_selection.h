// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/discontinuity_lines.h"
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
  std::size_t over_cap = 0;       ///< left out for the number of lines of their face
  std::vector<FaceId> cap_faces;  ///< where that was so, ascending
};

struct SelectionOptions {
  std::size_t most_per_face = 60;
  double distance_m = 1e-3;  ///< lines closer to each other are one
};

/// Keeps the lines across which an interpolation would miss more than it may.
/// @param weight  of a line: what an interpolation across it misses, in units of what it may miss; lines above 1 are kept
LineSelection select_lines(std::span<const DiscontinuityLine> lines,
                           const std::function<double(const DiscontinuityLine&)>& weight,
                           const SelectionOptions& options = {});

}  // namespace clerestory::mesh
