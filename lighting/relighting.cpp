// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/relighting.h"

#include <algorithm>
#include <utility>

#include "lighting/cast_sun.h"
#include "lighting/received_flux.h"
#include "lighting/relaxation.h"
#include "lighting/scene.h"
#include "lighting/scene_hash.h"

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

void give(const std::vector<GroupDirect>& direct, Solution& solution) {
  for (const GroupDirect& given : direct) {
    for (LinearValue& sum : solution.direct(given.node)) {
      sum.value += given.lux.value;
      sum.slope_u += given.lux.slope_u;
      sum.slope_v += given.lux.slope_v;
    }
  }
}

std::vector<NodeLux> by_suns(const std::vector<GroupDirect>& direct, const Scene& scene) {
  std::vector<NodeLux> suns;
  if (!scene.sky.sun.shines()) return suns;
  for (const GroupDirect& given : direct) {
    if (given.group == scene.groups.of_sun()) suns.push_back({given.node, given.lux.value});
  }
  return suns;
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

}  // namespace

Relighting::Relighting(Solution& solution, Transport transport, KnownLight known, double accuracy)
    : solution_(solution),
      transport_(std::move(transport)),
      known_(std::move(known)),
      accuracy_(accuracy),
      given_errors_(transport_.given_errors),
      seed_(transport_.errors.seed()) {}

void Relighting::cast(const Sun& sun, const std::string& name) {
  auto own = std::find_if(known_.groups.begin(), known_.groups.end(),
                          [&](const SourceGroup& g) { return g.kind == SourceGroup::Kind::kSun && g.name == name; });
  if (own == known_.groups.end()) own = known_.groups.insert(own, {name, SourceGroup::Kind::kSun});
  own->strength = sun.normal_illuminance_lux;
  own->source = source_of(sun);
  const auto group = static_cast<std::uint32_t>(own - known_.groups.begin());
  std::erase_if(known_.direct, [&](const GroupDirect& given) { return given.group == group; });
  std::erase_if(known_.errors, [&](const GroupError& given) { return given.group == group; });
  const CastSun found = cast_sun(solution_, sun, group, accuracy_, seed_);
  known_.direct.insert(known_.direct.end(), found.direct.begin(), found.direct.end());
  known_.errors.insert(known_.errors.end(), found.errors.begin(), found.errors.end());
}

void Relighting::add_errors(const FittedLight& fitted) {
  const std::vector<double> flux = sunless_flux(solution_, by_suns(fitted.direct, solution_.scene()));
  std::vector<Solution::Errors>& errors = transport_.given_errors;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double before_lm = transport_.given_lm[i];
    const double ratio = before_lm > 0.0 ? flux[i] / before_lm : 1.0;
    const auto squared = static_cast<float>(ratio * ratio);
    errors[i] = {squared * given_errors_[i].noise2, squared * given_errors_[i].misfit2};
  }
  for (const GroupError& given : fitted.errors) {
    errors[given.node.index()].noise2 += given.errors.noise2;
    errors[given.node.index()].misfit2 += given.errors.misfit2;
  }
  for (std::size_t i = 0; i < errors.size(); ++i)
    solution_.add_error(ElementId(i), errors[i].noise2, errors[i].misfit2);
}

const Transport& Relighting::light(const Progress& progress) {
  const Scene& scene = solution_.scene();
  FittedLight fitted = fit(known_, scene);
  if (fitted.lacks_sun) {
    cast(scene.sky.sun, "sun");
    fitted = fit(known_, scene);
  }
  solution_.darken();
  give(fitted.direct, solution_);
  solution_.push_pull();
  const Relaxed relaxed = relax(solution_, transport_.clusters, transport_.arrivals, progress, Change::kOfElements);
  transport_.iterations = relaxed.iterations;
  transport_.convergence = relaxed.missing;
  add_errors(fitted);
  add_link_errors(solution_, transport_.clusters, transport_.arrivals);
  transport_.errors = SolutionErrors(solution_, transport_.arrivals, transport_.clusters, relaxed.missing, seed_);
  transport_.by_luminaires_lm = flux_by_luminaires(fitted.direct, solution_);
  transport_.groups = std::move(fitted.direct);
  return transport_;
}

}  // namespace clerestory::lighting
