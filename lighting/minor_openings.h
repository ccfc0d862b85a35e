// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace clerestory::lighting {

/// An opening through which a node may be lit so little that a few rays do.
struct MinorOpening {
  std::uint32_t opening = 0;
  float weight = 1.0F;  ///< of its light: above 1 where it stands for others that were not drawn
};

/// Of many openings draws a few to stand for all, those that may give more the likelier: sums of weight times light stay right on the
/// mean. Systematic sampling with probability proportional to size [Madow 1949]; those that would be drawn more than once are taken for sure.
/// @param sizes  [openings] > 0, about what each may give
/// @param most   openings that are kept
/// @param start  where to begin, in [0, 1): of an even distribution
void draw_openings(std::span<const double> sizes, std::size_t most, double start, std::vector<MinorOpening>& openings);

}  // namespace clerestory::lighting
