// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/resolve.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "lighting/arrivals.h"
#include "lighting/clusters.h"
#include "lighting/relaxation.h"
#include "lighting/scene.h"
#include "mesh/error.h"

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("", 0, "the stored solution cannot answer this: " + what,
                   "run the study again with --save-solution");
}

/// How much brighter each group has become.
std::vector<double> ratios_of(const StoredSolution& stored, const SourceGroups& groups) {
  if (stored.group_names.size() != groups.count()) refuse("it tells other sources apart");
  std::vector<double> ratios;
  for (std::size_t g = 0; g < groups.count(); ++g) {
    const double before = stored.group_strengths[g];
    if (groups[g].name != stored.group_names[g]) refuse("it does not know the group '" + groups[g].name + "'");
    if (before <= 0.0 && groups[g].strength > 0.0) refuse("it has no light of '" + groups[g].name + "'");
    ratios.push_back(before > 0.0 ? groups[g].strength / before : 0.0);
  }
  return ratios;
}

/// The direct light of each group as it has become.
std::vector<GroupDirect> direct_light(const StoredSolution& stored, const Solution& solution) {
  const std::vector<double> ratios = ratios_of(stored, solution.scene().groups);
  std::vector<GroupDirect> direct;
  direct.reserve(stored.group_nodes.size());
  for (std::size_t i = 0; i < stored.group_nodes.size(); ++i) {
    const auto [node, group] = stored.group_nodes[i];
    if (node >= solution.tree().size() || group >= ratios.size()) refuse("it is damaged");
    const auto ratio = static_cast<float>(ratios[group]);
    const LinearValue lux = line_of(stored.group_lux[i]);
    direct.push_back({ElementId(node), group, {ratio * lux.value, ratio * lux.slope_u, ratio * lux.slope_v}});
  }
  return direct;
}

void give(const std::vector<GroupDirect>& direct, Solution& solution) {
  for (const GroupDirect& given : direct) {
    for (LinearValue& sum : solution.direct(given.node)) {
      sum.value += given.lux.value;
      sum.slope_u += given.lux.slope_u;
      sum.slope_v += given.lux.slope_v;
    }
  }
}

/// What opaque nodes are given by groups of luminaires [lm].
double flux_by_luminaires(const std::vector<GroupDirect>& direct, const Solution& solution) {
  const std::vector<std::uint32_t>& of = solution.scene().luminaire_group;
  double flux_lm = 0.0;
  for (const GroupDirect& given : direct) {
    const bool pane = solution.scene().is_pane(solution.tree().face_side(given.node));
    if (!pane && std::find(of.begin(), of.end(), given.group) != of.end())
      flux_lm += solution.tree().area(given.node) * given.lux.value;
  }
  return flux_lm;
}

/// Light that nodes receive in all [lm], as it was and as it is [nodes].
struct Flux {
  double before = 0.0;
  double now = 0.0;
};

std::vector<Flux> flux_of(const StoredSolution& stored, const Solution& solution) {
  const mesh::ElementTree& tree = solution.tree();
  std::vector<Flux> flux(tree.size());
  for (std::size_t i = 0; i < stored.elements.size(); ++i) {
    const ElementId e(stored.elements[i]);
    Flux own;
    for (std::size_t c = 0; c < stored.channels; ++c) {
      const double weight = solution.scene().channel_weights[c] * tree.area(e);
      own.before += weight * stored.irradiance[i * stored.channels + c][0];
      own.now += weight * solution.irradiance(e)[c].value;
    }
    for (ElementId up = e; up.valid(); up = tree.parent(up)) {
      flux[up.index()].before += own.before;
      flux[up.index()].now += own.now;
    }
  }
  return flux;
}

/// Errors by rays, as large in relation to the light as they were.
std::vector<Solution::Errors> given_errors(const StoredSolution& stored, const Solution& solution) {
  const std::vector<Flux> flux = flux_of(stored, solution);
  const std::vector<ElementId> nodes = nodes_of(solution);
  std::vector<Solution::Errors> errors(solution.tree().size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Flux& own = flux[nodes[i].index()];
    const double ratio = own.before > 0.0 ? own.now / own.before : 1.0;
    const auto squared = static_cast<float>(ratio * ratio);
    errors[nodes[i].index()] = {squared * stored.given_errors[i][0], squared * stored.given_errors[i][1]};
  }
  return errors;
}

}  // namespace

Transport resolve(const StoredSolution& stored, Solution& solution, const Progress& progress) {
  regrow(stored, solution);
  Transport transport;
  transport.groups = direct_light(stored, solution);
  transport.clusters = Clusters(solution.scene(), solution.tree());
  transport.arrivals = stored_arrivals(stored, solution, transport.clusters.size());
  give(transport.groups, solution);
  transport.by_luminaires_lm = flux_by_luminaires(transport.groups, solution);
  for (std::size_t i = 0; i < stored.elements.size(); ++i)
    solution.close(ElementId(stored.elements[i]), line_of(stored.closing[i]));
  const Arrivals& arrivals = transport.arrivals;
  solution.push_pull();
  const Relaxed relaxed = relax(solution, transport.clusters, arrivals, progress, Change::kOfElements);
  transport.iterations = relaxed.iterations;
  transport.convergence = relaxed.missing;
  transport.given_errors = given_errors(stored, solution);
  for (std::size_t i = 0; i < transport.given_errors.size(); ++i)
    solution.add_error(ElementId(i), transport.given_errors[i].noise2, transport.given_errors[i].misfit2);
  add_link_errors(solution, transport.clusters, arrivals);
  transport.errors = SolutionErrors(solution, arrivals, transport.clusters, relaxed.missing, stored.seed);
  return transport;
}

}  // namespace clerestory::lighting
