// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/channel_system.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Vector;

ChannelSystem::ChannelSystem(const Solution& solution, const Arrivals& arrivals, const Clusters& all) {
  add_rows(solution);
  add_clusters(all);
  add_terms(arrivals);
}

void ChannelSystem::add_rows(const Solution& solution) {
  const mesh::ElementTree& tree = solution.tree();
  row_of_.assign(tree.size(), kNone);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const ElementId e(i);
    const ElementId parent = tree.parent(e);
    if (parent.valid() && (row_of(parent) == kNone || !solution.is_open(parent))) continue;
    Row row;
    row.node = e;
    row.is_element = !solution.is_open(e);
    row.closing = solution.closing(e);
    row.is_closed = row.is_element && solution.is_closed(e);
    row.area = tree.second_moments(e);
    if (parent.valid()) {
      row.parent = row_of(parent);
      row.place = {tree, e};
    }
    row_of_[i] = static_cast<std::uint32_t>(rows.size());
    rows.push_back(row);
  }
}

void ChannelSystem::add_clusters(const Clusters& all) {
  const auto first = static_cast<std::uint32_t>(rows.size());
  for (std::uint32_t c = 0; c < all.size(); ++c) {
    if (all.is_leaf(c)) {
      clusters.push_back({row_of(all.root(c)), kNone, 1.0F});
    } else {
      clusters.push_back(
          {first + all.left(c), first + all.right(c), static_cast<float>(all.area(all.left(c)) / all.area(c))});
    }
  }
}

void ChannelSystem::add_terms(const Arrivals& arrivals) {
  const auto first_cluster = static_cast<std::uint32_t>(rows.size());
  first_term.push_back(0);
  terms.reserve(arrivals.count());
  for (std::size_t i = 0; i < arrivals.receivers(); ++i) {
    receivers.push_back(row_of(arrivals.receiver(i)));
    for (const Arrival& arrival : arrivals.at(i)) {
      const LinkSource from = arrival.source();
      const std::uint32_t source = from.is_cluster() ? first_cluster + from.cluster() : row_of(from.element());
      terms.push_back({source, arrival.factor(), arrival.slopes()});
    }
    first_term.push_back(static_cast<std::uint32_t>(terms.size()));
  }
}

}  // namespace clerestory::lighting
