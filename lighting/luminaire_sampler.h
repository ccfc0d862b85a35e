// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lighting/channels.h"
#include "lighting/linear_fit.h"
#include "lighting/luminaire_view.h"
#include "lighting/replicates.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// How the light of luminaires changes over a node.
struct LuminaireSurvey {
  std::vector<LuminaireView> views;  ///< those that may light it
  double mean_lux = 0.0;
  LinearFit fit;
};

/// Looks from nodes at the luminaires. Most of their light may fall on a small part of a node, so that few places tell little of the mean.
class LuminaireSampler {
 public:
  /// @param flux_tolerance_lm  what the flux that falls on a node may be wrong by, however little the node matters to the sensors
  LuminaireSampler(const Solution& solution, std::uint64_t seed, double flux_tolerance_lm)
      : solution_(solution), seed_(seed), flux_tolerance_lm_(flux_tolerance_lm) {}

  /// @param known  of the node that it is a part of
  [[nodiscard]] LuminaireSurvey survey(mesh::ElementId e, std::span<const LuminaireView> known) const;
  /// The mean over a node, sampled until its standard error is under both tolerances or the most places are seen [lux]; the groups of the
  /// luminaires are given what is theirs.
  [[nodiscard]] ReplicateMean mean(mesh::ElementId e, std::span<const LuminaireView> views, double tolerance_lux,
                                   GroupSums& groups) const;

 private:
  [[nodiscard]] double lux(mesh::ElementId e, std::span<const LuminaireView> views, const mesh::Point& p,
                           GroupSums& groups) const;

  const Solution& solution_;
  std::uint64_t seed_;
  double flux_tolerance_lm_;
};

}  // namespace clerestory::lighting
