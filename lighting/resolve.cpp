// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/resolve.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "lighting/scene.h"

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

/// Errors by rays of the nodes that take part, and the light that they belong to.
void give_errors(const StoredSolution& stored, const Solution& solution, Transport& transport) {
  const std::vector<ElementId> nodes = nodes_of(solution);
  transport.given_errors.resize(solution.tree().size());
  transport.given_lm.resize(solution.tree().size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::size_t node = nodes[i].index();
    transport.given_errors[node] = {stored.given_errors[i][0], stored.given_errors[i][1]};
    transport.given_lm[node] = stored.given_lm[i];
  }
}

}  // namespace

Relighting relighting_of(const StoredSolution& stored, Solution& solution) {
  Transport transport;
  transport.errors = restore(stored, solution);
  transport.clusters = Clusters(solution.scene(), solution.tree());
  transport.arrivals = stored_arrivals(stored, solution, transport.clusters.size());
  give_errors(stored, solution, transport);
  for (std::size_t i = 0; i < stored.elements.size(); ++i)
    solution.close(ElementId(stored.elements[i]), line_of(stored.closing[i]));
  return {solution, std::move(transport), stored_light(stored, solution), stored.accuracy};
}

}  // namespace clerestory::lighting
