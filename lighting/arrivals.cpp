// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/arrivals.h"

#include <algorithm>

namespace clerestory::lighting {

using mesh::ElementId;

Arrivals::Arrivals(const std::vector<Link>& links, const mesh::ElementTree& tree) : links_(&links), tree_(&tree) {
  arrivals_.reserve(2 * links.size());
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    arrivals_.push_back({links[i].receiver, i, false});
    if (links[i].mutual) arrivals_.push_back({links[i].source.element(), i, true});
  }
  std::stable_sort(arrivals_.begin(), arrivals_.end(),
                   [](const Arrival& a, const Arrival& b) { return a.receiver < b.receiver; });
  for (std::size_t i = 0; i < arrivals_.size(); ++i) {
    if (i == 0 || arrivals_[i].receiver != arrivals_[i - 1].receiver) starts_.push_back(i);
  }
  starts_.push_back(arrivals_.size());
}

Link Arrivals::arriving(const Arrival& arrival) const {
  const Link& link = (*links_)[arrival.link];
  return arrival.back ? reversed(link, *tree_) : link;
}

std::size_t Arrivals::index_of(ElementId node) const {
  const auto found = std::lower_bound(starts_.begin(), starts_.end() - 1, node,
                                      [&](std::size_t start, ElementId e) { return arrivals_[start].receiver < e; });
  if (found == starts_.end() - 1 || arrivals_[*found].receiver != node) return receivers();
  return static_cast<std::size_t>(found - starts_.begin());
}

}  // namespace clerestory::lighting
