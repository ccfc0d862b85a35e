// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/channel_deviations.h"

#include <algorithm>
#include <cmath>

#include "lighting/parallel.h"

namespace clerestory::lighting {

namespace {

constexpr std::size_t kChannelsOfBlock = 16;

/// Radiosity of a node or cluster in one channel.
struct Pulled {
  MeanAndMoments<double> sent;
  double square = 0.0;  ///< mean of the square

  [[nodiscard]] double variance() const { return std::max(0.0, square - sent.mean * sent.mean); }
};

Pulled of_element(const LinearValue& line, const mesh::SecondMoments& area) {
  const Moments m = moments_of(line, area);
  const double mean = line.value;
  return {{mean, m.u, m.v}, mean * mean + line.slope_u * m.u + line.slope_v * m.v};
}

void hand_up(const ChannelSystem::Row& row, const Pulled& part, Pulled& parent) {
  parent.sent.add_part(part.sent, row.place);
  parent.square += row.place.share * part.square;
}

/// What the line through a node explains, comes off the variance.
double deviation_from_line(const Pulled& own, const mesh::SecondMoments& area) {
  const auto& [mean, u, v] = own.sent;
  const double determinant = area.uu * area.vv - area.uv * area.uv;
  const double explained =
      determinant > 0.0 ? (u * u * area.vv - 2.0 * u * v * area.uv + v * v * area.uu) / determinant : 0.0;
  return std::sqrt(std::max(0.0, own.variance() - explained));
}

void raise(float& most, double value) { most = std::max(most, static_cast<float>(value)); }

/// Pulls some channels up, one after the other, and keeps the largest deviation of each row.
std::vector<float> largest(const ChannelSystem& system, std::size_t first, std::size_t last, const ChannelLine& line) {
  std::vector<float> most(system.row_count(), 0.0F);
  for (std::size_t channel = first; channel < last; ++channel) {
    std::vector<Pulled> pulled(system.row_count());
    for (std::size_t r = system.rows.size(); r-- > 0;) {
      const ChannelSystem::Row& row = system.rows[r];
      if (row.is_element) {
        pulled[r] = of_element(line(row.node, channel), row.area);
      } else {
        raise(most[r], deviation_from_line(pulled[r], row.area));
      }
      if (row.parent != ChannelSystem::kNone) hand_up(row, pulled[r], pulled[row.parent]);
    }
    for (std::size_t c = system.clusters.size(); c-- > 0;) {
      const ChannelSystem::Cluster& cluster = system.clusters[c];
      const std::size_t own = system.rows.size() + c;
      const auto add = [&](std::uint32_t part, double share) {
        pulled[own].sent.mean += share * pulled[part].sent.mean;
        pulled[own].square += share * pulled[part].square;
      };
      add(cluster.left, cluster.left_share);
      if (cluster.right != ChannelSystem::kNone) add(cluster.right, 1.0 - cluster.left_share);
      raise(most[own], std::sqrt(pulled[own].variance()));
    }
  }
  return most;
}

}  // namespace

ChannelDeviations channel_deviations(const ChannelSystem& system, std::size_t nodes, std::size_t channels,
                                     const ChannelLine& line) {
  std::vector<std::vector<float>> blocks((channels + kChannelsOfBlock - 1) / kChannelsOfBlock);
  parallel_for(blocks.size(), [&](std::size_t b) {
    blocks[b] = largest(system, b * kChannelsOfBlock, std::min(channels, (b + 1) * kChannelsOfBlock), line);
  });
  ChannelDeviations deviations;
  deviations.nodes.assign(nodes, 0.0F);
  deviations.clusters.assign(system.clusters.size(), 0.0F);
  for (const std::vector<float>& block : blocks) {
    for (std::size_t r = 0; r < system.rows.size(); ++r) raise(deviations.nodes[system.rows[r].node.index()], block[r]);
    for (std::size_t c = 0; c < system.clusters.size(); ++c)
      raise(deviations.clusters[c], block[system.rows.size() + c]);
  }
  return deviations;
}

}  // namespace clerestory::lighting
