// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/direct_light.h"

#include <algorithm>
#include <span>
#include <utility>

#include "lighting/direct_sampler.h"
#include "lighting/element_limit.h"
#include "lighting/parallel.h"
#include "mesh/phase_part.h"

namespace clerestory::lighting {

using mesh::ElementId;

namespace {

constexpr double kSmallest = 0.02;    ///< nodes of a smaller radius are not opened [m]
constexpr std::size_t kBatch = 1024;  ///< nodes between two signs of life
/// Of the time, measured on the validation scenes.
constexpr double kShareOfSurveys = 0.5;

/// What a root looks at: everything. Lists are made for one root at a time, as all of theirs would fill the memory of a large scene.
class Roots {
 public:
  explicit Roots(const Solution& solution) : luminaires_(any_luminaires(solution.scene())) {
    for (std::uint32_t k = 0; k < solution.scene().openings.size(); ++k) openings_.push_back(k);
  }

  [[nodiscard]] DirectCandidate candidate(ElementId root) const {
    DirectCandidate all;
    all.node = root;
    all.openings = openings_;
    all.luminaires = luminaires_;
    return all;
  }

 private:
  std::vector<std::uint32_t> openings_;
  std::vector<LuminaireView> luminaires_;
};

/// Opens a node; its children look at what it has seen.
void open(Solution& solution, const DirectSurvey& survey, std::vector<DirectCandidate>& next) {
  const ElementId e = survey.below.node;
  solution.open(e);
  for (std::size_t k = 0; k < solution.tree().child_count(e); ++k) {
    DirectCandidate child = survey.below;
    child.node = ElementId(solution.tree().first_child(e).index() + k);
    next.push_back(std::move(child));
  }
}

/// Nodes as they were surveyed last.
struct Surveyed {
  std::vector<DirectSurvey> nodes;
  bool out_of_elements = false;
};

/// Whether each of surveyed nodes is to be opened [surveys], because a line over it will not do; notes where not all of these may be.
std::vector<std::uint8_t> to_open(Solution& solution, const DirectSampler& sampler, double tolerance_lux,
                                  std::span<const DirectSurvey> surveys, bool& out_of_elements) {
  std::vector<std::size_t> coarse;
  std::vector<ElementId> nodes;
  std::vector<double> effects;
  for (std::size_t i = 0; i < surveys.size(); ++i) {
    const ElementId node = surveys[i].below.node;
    const double effect = sampler.effect(surveys[i]);
    if (effect <= tolerance_lux || solution.tree().radius(node) < kSmallest) continue;
    coarse.push_back(i);
    nodes.push_back(node);
    effects.push_back(effect);
  }
  if (!open_worthiest(solution, nodes, [&](std::size_t k) { return effects[k]; })) out_of_elements = true;
  std::vector<std::uint8_t> chosen(surveys.size(), 0);
  for (std::size_t k = 0; k < coarse.size(); ++k) chosen[coarse[k]] = solution.may_open(nodes[k]) ? 1 : 0;
  return chosen;
}

/// Opens nodes until a line over each of them will do, or the run must go on: then all is looked at roughly.
Surveyed survey_all(Solution& solution, const DirectSampler& sampler, double tolerance_lux, Progress& progress) {
  Surveyed accepted;
  const Roots roots(solution);
  std::vector<DirectCandidate> round(solution.tree().roots().size());
  for (std::size_t i = 0; i < round.size(); ++i) round[i].node = solution.tree().roots()[i];
  bool is_first = true;
  double surveyed = 0.0;
  double share = 0.0;
  while (!round.empty()) {
    std::vector<DirectCandidate> next;
    for (std::size_t first = 0; first < round.size(); first += kBatch) {
      const std::size_t batch = std::min(kBatch, round.size() - first);
      std::vector<DirectSurvey> surveys(batch);
      const bool roughly = progress.should_finish();
      parallel_for(batch, [&](std::size_t i) {
        const DirectCandidate& own = round[first + i];
        surveys[i] = sampler.survey(is_first ? roots.candidate(own.node) : own, roughly);
      });
      std::vector<std::uint8_t> chosen(batch, 0);
      if (!progress.should_finish())
        chosen = to_open(solution, sampler, tolerance_lux, surveys, accepted.out_of_elements);
      for (std::size_t i = 0; i < batch; ++i) {
        if (chosen[i] != 0)
          open(solution, surveys[i], next);
        else
          accepted.nodes.push_back(std::move(surveys[i]));
      }
      surveyed += static_cast<double>(batch);
      const std::size_t waiting = round.size() - first - batch + next.size();
      share = std::max(share, surveyed / (surveyed + static_cast<double>(waiting)));
      progress.advance(share);
    }
    round = std::move(next);
    is_first = false;
  }
  return accepted;
}

std::vector<DirectMeasurement> measure_all(const DirectSampler& sampler, const std::vector<DirectSurvey>& surveys,
                                           Progress& progress) {
  std::vector<DirectMeasurement> measured(surveys.size());
  for (std::size_t first = 0; first < surveys.size(); first += kBatch) {
    const std::size_t end = std::min(first + kBatch, surveys.size());
    parallel_for(end - first, [&](std::size_t i) {
      measured[first + i] = sampler.measure(surveys[first + i], progress.should_finish());
    });
    progress.advance(static_cast<double>(end) / static_cast<double>(surveys.size()));
  }
  return measured;
}

/// Light of each group changes over the node as the sum of all does; that of the sky of a moment as it does itself.
void part(const SourceGroups& all, const DirectSurvey& survey, const DirectMeasurement& measured,
          std::vector<GroupDirect>& groups) {
  for (const GroupLight& light : measured.groups) {
    const auto lux = static_cast<float>(light.lux);
    LinearValue line{lux, lux * measured.slope.slope_u, lux * measured.slope.slope_v};
    for (std::size_t m = 0; m < measured.moment_slopes.size(); ++m) {
      const LinearValue& own = measured.moment_slopes[m];
      if (light.group == all.of_sky_at(m)) line = {lux, own.slope_u, own.slope_v};
    }
    groups.push_back({survey.below.node, light.group, line});
  }
}

NodeDirect accept(Solution& solution, const DirectSurvey& survey, const DirectMeasurement& measured) {
  NodeDirect node;
  node.node = survey.below.node;
  node.openings = survey.below.openings;
  node.minor = survey.below.minor;
  node.luminaires = survey.below.luminaires;
  node.open_sky = survey.below.open_sky;
  const LinearValue slope = measured.slope;
  const auto received = static_cast<float>(measured.received);
  node.received = {received, received * slope.slope_u, received * slope.slope_v};
  for (LinearValue& v : solution.direct(node.node)) v = node.received;
  solution.add_error(node.node, measured.noise * measured.noise, survey.sunless_residual() * survey.sunless_residual());
  return node;
}

/// What suns give, where any does.
void part_suns(const DirectSurvey& survey, const DirectMeasurement& measured, std::vector<SunDirect>& suns) {
  const double misfit = survey.sun_residual;
  if (measured.by_suns.mean <= 0.0 && misfit <= 0.0) return;
  const Solution::Errors errors{static_cast<float>(measured.by_suns.variance), static_cast<float>(misfit * misfit)};
  suns.push_back({{survey.below.node, measured.by_suns.mean}, errors});
}

}  // namespace

DirectLight light_directly(Solution& solution, const Importance& importance, double tolerance, std::uint64_t seed,
                           Progress& progress) {
  DirectLight result;
  result.scale_lux = importance.mean_lux();
  const double tolerance_lux = tolerance * result.scale_lux;
  const DirectSampler sampler(solution, importance, tolerance, seed);
  PhasePart looking(progress, 0.0, kShareOfSurveys);
  const Surveyed surveyed = survey_all(solution, sampler, tolerance_lux, looking);
  const std::vector<DirectSurvey>& accepted = surveyed.nodes;
  result.out_of_elements = surveyed.out_of_elements;
  PhasePart measuring(progress, kShareOfSurveys, 1.0);
  const std::vector<DirectMeasurement> measured = measure_all(sampler, accepted, measuring);
  for (std::size_t i = 0; i < accepted.size(); ++i) {
    result.nodes.push_back(accept(solution, accepted[i], measured[i]));
    part_suns(accepted[i], measured[i], result.suns);
    part(solution.scene().groups, accepted[i], measured[i], result.groups);
    const ElementId node = accepted[i].below.node;
    if (!solution.scene().is_pane(solution.tree().face_side(node)))
      result.by_luminaires_lm += solution.tree().area(node) * measured[i].by_luminaires;
    // Light through openings changes over the node as the sum of it does.
    const std::vector<Link> links =
        links_to_seen(solution, accepted[i].below.node, measured[i].beyond, measured[i].slope);
    result.links.insert(result.links.end(), links.begin(), links.end());
  }
  return result;
}

}  // namespace clerestory::lighting
