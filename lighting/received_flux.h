// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lighting/solution.h"
#include "mesh/ids.h"

namespace clerestory::lighting {

/// What a node is given straight, on the mean.
struct NodeLux {
  mesh::ElementId node;
  double lux = 0.0;
};

/// Light that each node receives in all, but for what some are given straight by suns, which is left out of the nodes above and below these
/// too [nodes, lm]. What rounding alone leaves is none.
std::vector<double> sunless_flux(const Solution& solution, const std::vector<NodeLux>& suns);

}  // namespace clerestory::lighting
