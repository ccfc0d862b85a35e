// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/resolve.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "lighting/scene.h"

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

/// Errors by rays of the nodes that take part.
std::vector<Solution::Errors> given_errors(const StoredSolution& stored, const Solution& solution) {
  const std::vector<ElementId> nodes = nodes_of(solution);
  std::vector<Solution::Errors> errors(solution.tree().size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    errors[nodes[i].index()] = {stored.given_errors[i][0], stored.given_errors[i][1]};
  return errors;
}

}  // namespace

Relighting relighting_of(const StoredSolution& stored, Solution& solution) {
  Transport transport;
  transport.errors = restore(stored, solution);
  transport.clusters = Clusters(solution.scene(), solution.tree());
  transport.arrivals = stored_arrivals(stored, solution, transport.clusters.size());
  transport.given_errors = given_errors(stored, solution);
  for (std::size_t i = 0; i < stored.elements.size(); ++i)
    solution.close(ElementId(stored.elements[i]), line_of(stored.closing[i]));
  return {solution, std::move(transport), stored_light(stored, solution), stored.accuracy};
}

}  // namespace clerestory::lighting
