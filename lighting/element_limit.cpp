// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/element_limit.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

bool fit(const Solution& solution, std::span<const ElementId> nodes) {
  std::size_t more = 0;
  for (const ElementId e : nodes) more += solution.gained_by_opening(e);
  if (more <= solution.elements_left()) return true;
  // Several pairs may ask for one node.
  more = 0;
  for (const ElementId e : std::set<ElementId>(nodes.begin(), nodes.end())) more += solution.gained_by_opening(e);
  return more <= solution.elements_left();
}

}  // namespace

bool open_worthiest(Solution& solution, std::span<const ElementId> nodes,
                    const std::function<double(std::size_t)>& worth) {
  if (fit(solution, nodes)) return true;
  std::vector<double> worths(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) worths[i] = worth(i);
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return worths[a] > worths[b]; });
  for (const std::size_t i : order) {
    if (solution.may_open(nodes[i])) solution.open(nodes[i]);
  }
  return false;
}

}  // namespace clerestory::lighting
