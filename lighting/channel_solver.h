// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lighting/channel_system.h"
#include "lighting/direct_light.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// What elements reflect of the light of each source group: luminance-weighted lines over the elements [lm/m²], groups side by side.
class GroupRadiosity {
 public:
  GroupRadiosity() = default;
  /// @param nodes  of the tree
  GroupRadiosity(std::size_t nodes, std::span<const mesh::ElementId> elements, std::size_t groups);

  [[nodiscard]] std::size_t groups() const { return groups_; }
  /// An element's values at its centroid, and slopes along its axes [1/m]: [3 × groups].
  [[nodiscard]] std::span<const float> lines(mesh::ElementId e) const {
    return std::span(lines_).subspan(3 * groups_ * row_[e.index()], 3 * groups_);
  }
  [[nodiscard]] std::span<float> lines(mesh::ElementId e) {
    return std::span(lines_).subspan(3 * groups_ * row_[e.index()], 3 * groups_);
  }
  std::size_t iterations = 0;  ///< the most that a block of channels took

 private:
  std::size_t groups_ = 0;
  std::vector<std::uint32_t> row_;  ///< [nodes] of elements
  std::vector<float> lines_;        ///< [elements × 3 × groups]
};

/// Solves for all channels, columns of groups × bands, on the links of a solution: the same gathering, push and pull, a block of channels at a
/// time, each until what is missing of it is far below any accuracy. The sum of all groups is the solution's own light.
/// @param direct  what the solution's direct light is made of
GroupRadiosity solve_channels(const Solution& solution, const ChannelSystem& system,
                              std::span<const GroupDirect> direct);

}  // namespace clerestory::lighting
