// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lighting/importance.h"
#include "lighting/linear_fit.h"
#include "lighting/luminaire_sampler.h"
#include "lighting/minor_openings.h"
#include "lighting/seen_surfaces.h"
#include "lighting/solution.h"
#include "lighting/sun_sampler.h"

namespace clerestory::lighting {

class SobolPoints;

/// A node, and what it has to look at.
struct DirectCandidate {
  mesh::ElementId node;
  std::vector<std::uint32_t> openings;    ///< those that may be seen
  std::vector<MinorOpening> minor;        ///< those that cannot matter much here: measured with few rays, not surveyed
  bool open_sky = true;                   ///< may see the sky by no opening
  bool minor_sky = false;                 ///< … which cannot matter much here
  std::vector<SunView> suns;              ///< [suns of the sky]; empty: nothing is known
  std::vector<LuminaireView> luminaires;  ///< those that may be seen
};

/// How direct light changes over a node. The same directions serve at every place: differences are then the light's own, and the mean
/// is left to measure().
struct DirectSurvey {
  LinearFit fit;              ///< of sky, sun, luminaires and the guess of what lies beyond openings
  LinearFit sources;          ///< of sun and luminaires alone
  double total = 0.0;         ///< the mean of all [lux]
  double sun_residual = 0.0;  ///< the part of the fit's that is of suns [lux]
  DirectCandidate below;      ///< what the node, or its children, need to look at

  /// What the line misses of all light but that of suns [lux].
  [[nodiscard]] double sunless_residual() const;
};

/// What a node receives on the mean, with independent places and directions.
struct DirectMeasurement {
  double received = 0.0;       ///< from sky, sun and luminaires [lux]
  double by_luminaires = 0.0;  ///< the part of it that comes from luminaires [lux]
  /// The same by group, where groups are told apart.
  std::vector<GroupLight> groups;
  double total = 0.0;     ///< with the guess of what lies beyond openings [lux]
  double noise = 0.0;     ///< standard error of total but for suns [lux]
  ReplicateMean by_suns;  ///< the part of total that comes straight from suns [lux]
  std::vector<SeenSurface> beyond;
  /// Of the illuminance over the node, per unit of its mean [1/m].
  LinearValue slope;
  /// Of the skies of several moments [lux/m]; their values are not used.
  std::vector<LinearValue> moment_slopes;
};

/// Looks from nodes at the sky, through openings, at the sun and at luminaires.
class DirectSampler {
 public:
  /// @param tolerance  error at the sensors that one node's direct light may cause, as a share of their mean; of all flux of luminaires, the share
  ///                   that may be missed on one
  DirectSampler(const Solution& solution, const Importance& importance, double tolerance, std::uint64_t seed);

  /// @param roughly  as if the node hardly mattered
  [[nodiscard]] DirectSurvey survey(const DirectCandidate& candidate, bool roughly = false) const;
  /// The error at the sensors [lux] where a line over the node stands for what was surveyed.
  [[nodiscard]] double effect(const DirectSurvey& survey) const;
  /// @param roughly  with the fewest rays, whatever the noise
  [[nodiscard]] DirectMeasurement measure(const DirectSurvey& survey, bool roughly = false) const;

 private:
  struct Probe;
  struct Places;
  struct Start;
  struct Part;

  [[nodiscard]] const Scene& scene() const { return solution_.scene(); }
  [[nodiscard]] double reflectance(mesh::ElementId e) const;
  [[nodiscard]] double tolerance(mesh::ElementId e) const;

  [[nodiscard]] double most_light() const;
  [[nodiscard]] double most_seen(mesh::ElementId e, std::uint32_t k) const;
  [[nodiscard]] double most_lux(mesh::ElementId e, std::int32_t opening) const;
  [[nodiscard]] std::uint32_t rays_to_begin(mesh::ElementId e, std::int32_t opening, std::size_t parts) const;
  [[nodiscard]] bool in_view(mesh::ElementId e, const mesh::ShaftEnd& own, std::uint32_t k) const;
  void keep_few(mesh::ElementId e, double allowed, std::uint64_t key, std::vector<MinorOpening>& minor) const;
  void measure_minor(const DirectCandidate& node, std::vector<Part>& parts) const;
  [[nodiscard]] bool sees(mesh::ElementId e, std::int32_t opening, double allowed) const;
  [[nodiscard]] Probe probe(mesh::ElementId e, std::int32_t opening, const SobolPoints& numbers, std::uint32_t i) const;
  [[nodiscard]] bool is_lit(const Probe& probe, std::int32_t opening) const;
  [[nodiscard]] Places places_on(mesh::ElementId e, std::uint64_t key) const;
  [[nodiscard]] Places look_out(const DirectCandidate& node, std::uint64_t key) const;
  void survey_opening(mesh::ElementId e, std::uint32_t k, std::span<const std::array<double, 2>> directions,
                      Places& places) const;
  void survey_sky(mesh::ElementId e, std::uint64_t key, Places& places) const;
  void add_suns(const DirectCandidate& candidate, DirectSurvey& result) const;
  void add_luminaires(const DirectCandidate& candidate, DirectSurvey& result) const;
  void find_slopes(const DirectSurvey& survey, DirectMeasurement& result) const;
  void extend(mesh::ElementId e, std::uint32_t until, Part& part) const;
  void improve(mesh::ElementId e, std::span<Part> parts) const;
  [[nodiscard]] Start start(mesh::ElementId e, std::int32_t opening, const SobolPoints& numbers, std::uint32_t i) const;

  const Solution& solution_;
  const Importance& importance_;
  double tolerance_lux_;
  std::uint64_t seed_;
  double brightest_;  ///< no more luminance outdoors [cd/m²]
  std::vector<SunSampler> suns_;
  LuminaireSampler luminaires_;
  std::vector<mesh::ShaftEnd> ends_;  ///< the openings
};

}  // namespace clerestory::lighting
