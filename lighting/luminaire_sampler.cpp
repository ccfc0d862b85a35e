// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminaire_sampler.h"

#include <algorithm>

#include "lighting/luminaire_light.h"
#include "lighting/sampled_mean.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;

namespace {

constexpr std::uint32_t kPlaces = 8;           ///< on a node, to see how light changes over it
constexpr std::uint32_t kPlacesInShadow = 32;  ///< where something may stand before a luminaire
constexpr std::uint32_t kFirstPlaces = 4;      ///< of each set
/// So many that of the ground beyond the windows, lit on a hundredth of it, the flux is known to some per cent.
constexpr std::uint32_t kMostPlaces = 4096;

bool all_clear(std::span<const LuminaireView> views) {
  return std::all_of(views.begin(), views.end(), [](const LuminaireView& view) { return view.clear(); });
}

}  // namespace

double LuminaireSampler::lux(ElementId e, std::span<const LuminaireView> views, const Point& p,
                             GroupSums& groups) const {
  const Scene& scene = solution_.scene();
  const mesh::Vector& normal = solution_.tree().normal(e);
  const Point at = p + scene.rays->offset_m() * normal;
  return luminaire_illuminance(scene, views, at, normal, kRoughMean, 1.0, groups).value;
}

LuminaireSurvey LuminaireSampler::survey(ElementId e, std::span<const LuminaireView> known) const {
  LuminaireSurvey result;
  const mesh::ElementTree& tree = solution_.tree();
  if (solution_.scene().luminaires.empty()) return result;
  result.views = narrowed(solution_.scene(), mesh::shaft_end(tree, e), known);
  const std::uint32_t places = all_clear(result.views) ? kPlaces : kPlacesInShadow;
  const SobolPoints numbers(mesh::hash(mesh::hash(seed_, tree.key(e)), 0x1A1));
  std::vector<PlaneSample> samples;
  GroupSums none;
  for (std::uint32_t i = 0; i < places; ++i) {
    const Point p = tree.sample(e, numbers.at(i, 0), numbers.at(i, 1));
    const mesh::Vector d = p - tree.centroid(e);
    samples.push_back({dot(d, tree.axes(e).u), dot(d, tree.axes(e).v), lux(e, result.views, p, none), 1.0 / places});
  }
  result.fit = fit_line(samples);
  result.mean_lux = result.fit.line.value;
  return result;
}

ReplicateMean LuminaireSampler::mean(ElementId e, std::span<const LuminaireView> views, double tolerance_lux,
                                     GroupSums& groups) const {
  if (solution_.scene().luminaires.empty()) return {};
  const mesh::ElementTree& tree = solution_.tree();
  const double allowed = std::min(tolerance_lux, flux_tolerance_lm_ / tree.area(e));
  const std::uint64_t key = mesh::hash(mesh::hash(seed_, tree.key(e)), 0x1A2);
  GroupSums sums_of_groups(solution_.scene().groups);
  const SampledMean mean = sampled_mean(
      key, kFirstPlaces, kMostPlaces,
      [&](const SobolPoints& numbers, std::uint32_t i) {
        return lux(e, views, tree.sample(e, numbers.at(i, 0), numbers.at(i, 1)), sums_of_groups);
      },
      [&](const ReplicateMean& found, std::uint32_t) { return found.standard_error() <= allowed; });
  for (const GroupLight& light : sums_of_groups.lit()) groups.add(light.group, light.lux / mean.samples);
  return mean;
}

}  // namespace clerestory::lighting
