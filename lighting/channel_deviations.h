// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "lighting/channel_system.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// How unevenly nodes and clusters shine in the channel in which they do so most: the largest over channels of the standard deviation of
/// the radiosity, by the channel's weight in luminance [lm/m²]; as Solution::radiosity_deviation() and Clusters::radiosity_deviation() have it
/// of all light. What is bright in one channel and dark in another one may be even in the sum of them. No channel is brighter than the sum.
struct ChannelDeviations {
  std::vector<float> nodes;     ///< [nodes of the tree]; 0 for those that take no part
  std::vector<float> clusters;  ///< [clusters]

  [[nodiscard]] float of(mesh::ElementId e) const { return e.index() < nodes.size() ? nodes[e.index()] : 0.0F; }
  [[nodiscard]] float of_cluster(std::uint32_t c) const { return c < clusters.size() ? clusters[c] : 0.0F; }
};

/// What an element sends out in a channel, by its weight in luminance, as a line over the element [lm/m²].
using ChannelLine = std::function<LinearValue(mesh::ElementId element, std::size_t channel)>;

ChannelDeviations channel_deviations(const ChannelSystem& system, std::size_t nodes, std::size_t channels,
                                     const ChannelLine& line);

}  // namespace clerestory::lighting
