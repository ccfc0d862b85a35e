// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/received_flux.h"

#include <cstddef>

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

/// Irradiances are in single precision, and sums of several.
constexpr double kRounding = 1e-5;

}  // namespace

std::vector<double> sunless_flux(const Solution& solution, const std::vector<NodeLux>& suns) {
  const mesh::ElementTree& tree = solution.tree();
  std::vector<double> given(tree.size(), 0.0);
  for (const NodeLux& sun : suns) given[sun.node.index()] += sun.lux;
  std::vector<double> flux(tree.size(), 0.0);
  for (const ElementId e : solution.elements()) {
    double all = 0.0;
    for (std::size_t c = 0; c < solution.channels(); ++c)
      all += solution.scene().channel_weights[c] * solution.irradiance(e)[c].value;
    double by_suns = 0.0;
    for (ElementId up = e; up.valid(); up = tree.parent(up)) by_suns += given[up.index()];
    const double left = all - by_suns;
    if (left <= kRounding * all) continue;
    for (ElementId up = e; up.valid(); up = tree.parent(up)) flux[up.index()] += tree.area(e) * left;
  }
  return flux;
}

}  // namespace clerestory::lighting
