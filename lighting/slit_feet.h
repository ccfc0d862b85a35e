// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/element_tree.h"
#include "mesh/slits.h"

// Private to lighting/.
namespace clerestory::lighting {

/// The feet of slits by face side. Next to one, what is seen through the slit changes over the slit's width, or over the distance from its
/// foot where that is more: pieces larger than that see much in a strip that their places may all miss.
class SlitFeet {
 public:
  SlitFeet(std::size_t faces, std::span<const mesh::Slit> slits);

  /// Whether a node is larger than the light through the slits at it lets it be.
  [[nodiscard]] bool is_coarse(const mesh::ElementTree& tree, mesh::ElementId e) const;

 private:
  std::vector<std::uint32_t>
      starts_;  ///< [sides + 1] side s has slits_[starts_[s]] … slits_[starts_[s+1]-1]; empty where there is none
  std::vector<mesh::Slit> slits_;
};

}  // namespace clerestory::lighting
