// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/cast_sun.h"

#include "lighting/parallel.h"
#include "lighting/sun_sampler.h"

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

class Caster {
 public:
  Caster(const Solution& solution, const SunSampler& sampler, std::uint32_t group, double accuracy)
      : solution_(solution), sampler_(sampler), group_(group), accuracy_(accuracy) {}

  void cast(ElementId node, SunView known, CastSun& result) const {
    const SunSurvey survey = sampler_.survey(node, known);
    if (survey.view == SunView::kNone) return;
    if (survey.view != SunView::kPartly || !solution_.is_open(node)) {
      give(node, survey, result);
      return;
    }
    const mesh::ElementTree& tree = solution_.tree();
    for (std::size_t k = 0; k < tree.child_count(node); ++k)
      cast(ElementId(tree.first_child(node).index() + k), survey.view, result);
  }

 private:
  void give(ElementId node, const SunSurvey& survey, CastSun& result) const {
    const ReplicateMean mean = sampler_.mean(node, survey.view, accuracy_ * survey.mean_lux);
    const LinearValue& line = survey.fit.line;
    result.direct.push_back({node, group_, {static_cast<float>(mean.mean), line.slope_u, line.slope_v}});
    const double noise = mean.standard_error();
    const double misfit = survey.fit.residual;
    result.errors.push_back({node, group_, {static_cast<float>(noise * noise), static_cast<float>(misfit * misfit)}});
  }

  const Solution& solution_;
  const SunSampler& sampler_;
  std::uint32_t group_;
  double accuracy_;
};

}  // namespace

CastSun cast_sun(const Solution& solution, const Sun& sun, std::uint32_t group, double accuracy, std::uint64_t seed) {
  const SunSampler sampler(solution, sun, seed);
  const Caster caster(solution, sampler, group, accuracy);
  const auto roots = solution.tree().roots();
  std::vector<CastSun> by_root(roots.size());
  parallel_for(
      roots.size(), [&](std::size_t i) { caster.cast(roots[i], SunView::kUnknown, by_root[i]); }, 1);
  CastSun all;
  for (const CastSun& own : by_root) {
    all.direct.insert(all.direct.end(), own.direct.begin(), own.direct.end());
    all.errors.insert(all.errors.end(), own.errors.begin(), own.errors.end());
  }
  return all;
}

}  // namespace clerestory::lighting
