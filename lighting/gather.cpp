// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "lighting/dark_share.h"
#include "lighting/emitters.h"
#include "lighting/lamp_bodies.h"
#include "lighting/light_paths.h"
#include "lighting/luminaire_light.h"
#include "lighting/openings.h"
#include "lighting/parallel.h"
#include "lighting/replicates.h"
#include "lighting/seen_factor.h"
#include "lighting/sensor_looker.h"
#include "lighting/sun_light.h"
#include "mesh/phase_part.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::Point;
using mesh::Vector;
using mesh::Visibility;

namespace {

/// Errors at sensors are brought to this share of the accuracy.
constexpr double kAimed = 0.93;
/// Sampling takes what discretisation leaves of the error that is aimed at, and half of it anyway, since more rays cannot mend what the
/// solution has wrong.
constexpr double kLeastSampling = 0.5;
constexpr double kMostFirstDoublings = 5.0;  ///< of the rays that all sensors begin with
constexpr std::uint32_t kMostRays = 65536;   ///< a replicate and part
/// Openings that the first ray of each replicate has missed are looked into where what these may have missed is more than this share of the
/// error allowed.
constexpr double kNeglected = 0.05;
/// What is seen with nothing in between is smooth, and soon exact: it gets this share of the sampling error, up to so many rays.
constexpr double kClearShare = 0.1;
constexpr std::uint32_t kMostClearRays = 256;
/// A replicate, until half of them have met light; of an opening or an emitter, until any has.
constexpr std::uint32_t kMostDarkRays = 256;

/// Of the time, for the first rays of all sensors; measured on the validation scenes.
constexpr double kShareOfBeginnings = 0.3;

/// Replicates of fewer rays than this must agree better before sampling stops: if all of them have missed a bright spot, they agree.
constexpr double kManyRays = 8.0;
/// The same under a sun, whose patches are small and a hundred times as bright as all around them.
constexpr double kManyRaysUnderSun = 128.0;

using Replicates = std::array<double, kReplicates>;

/// One part of a sensor's light: sums over rays, a replicate each.
struct Part : SensorPart {
  bool clear = false;      ///< nothing stands between the sensor and the opening
  bool looked_at = false;  ///< a dark opening whose most_lux is what is not hidden of it
  Replicates sums{};
  Replicates norms{};  ///< what the sums are shares of
  ErrorSums wrong{};   ///< what the light of surfaces may be wrong by in each of the samples, summed up over all rays

  [[nodiscard]] ReplicateMean estimate() const {
    Replicates values{};
    for (std::size_t r = 0; r < kReplicates; ++r) values[r] = norms[r] > 0.0 ? sums[r] / norms[r] : 0.0;
    return mean_of_replicates(values);
  }
  [[nodiscard]] double mean() const { return estimate().mean; }
  /// Of the mean. Where n rays have all missed, up to 3/n of what they were sent to may be seen (with 95 % confidence [Hanley, Lippman-Hand
  /// 1983]): a standard error of 1/n, since none is no proof of nothing.
  [[nodiscard]] double variance() const {
    if (lit() > 0) return estimate().variance;
    const double missed = most_lux / (static_cast<double>(kReplicates) * rays);
    return missed * missed;
  }
  /// Replicates that have met light.
  [[nodiscard]] std::size_t lit() const {
    return static_cast<std::size_t>(std::count_if(sums.begin(), sums.end(), [](double s) { return s > 0.0; }));
  }
};

/// Rays a replicate to begin with: one at an accuracy of 8 %, and so many more for a better one that the error falls with it, up to 32.
/// By these the errors tell what more a sensor needs.
std::uint32_t first_rays(double accuracy) {
  const double doublings = std::round(1.5 * std::log2(0.08 / accuracy));
  return 1U << static_cast<unsigned>(std::clamp(doublings, 0.0, kMostFirstDoublings));
}

struct SensorState {
  std::vector<Part> parts;
  double exact_lux = 0.0;           ///< proven views of emitters, luminaires, a sun without a disc
  std::vector<GroupLight> exact;    ///< the same by group, where groups are told apart
  double luminaires_lux = 0.0;      ///< error that luminaires' areas make here
  double discretisation_lux = 0.0;  ///< this, and what the solution's own errors make

  [[nodiscard]] double mean() const {
    double sum = exact_lux;
    for (const Part& p : parts) sum += p.mean();
    return sum;
  }
  [[nodiscard]] double sampling_error() const {
    double sum = 0.0;
    for (const Part& p : parts) sum += p.variance();
    return kStudent * std::sqrt(sum);
  }
  /// The same, larger where rays are fewer than so many a replicate: what decides whether to go on.
  [[nodiscard]] double cautious_error(double many_rays) const {
    double sum = 0.0;
    for (const Part& p : parts) sum += p.variance() * std::sqrt(std::max(1.0, many_rays / p.rays));
    return kStudent * std::sqrt(sum);
  }
};

/// Adds rays up to a part.
struct PartTaker {
  const Solution* solution;
  const SolutionErrors* errors;
  Part* part;

  template <class Trace, class Scale>
  void ray(std::size_t r, const Trace& trace, const Scale& scale) {
    SensorLooker looker{solution, errors};
    trace(looker);
    part->sums[r] += scale(looker.lux);
    for (std::size_t k = 0; k < looker.wrong.size(); ++k) part->wrong[k] += scale(looker.wrong[k]);
    part->norms[r] += 1.0;
  }
  void miss(std::size_t r) { part->norms[r] += 1.0; }
  void sun(std::size_t r, double lux) {
    part->sums[r] += lux;
    part->norms[r] += 1.0;
  }
  /// The kernel-weighted share of an emitter that the sensor sees, times what all of it would give.
  void seen(std::size_t r, double kernel, double passed) {
    part->sums[r] += part->full_lux * kernel * passed;
    part->norms[r] += kernel;
  }
};

/// The sampling error to reach, for an error of all to be allowed [lux].
double sampling_goal(const SensorState& state, double allowed_lux) {
  const double aimed = kAimed * allowed_lux;
  const double left = std::sqrt(std::max(0.0, aimed * aimed - state.discretisation_lux * state.discretisation_lux));
  return std::max(left, kLeastSampling * aimed);
}

class Gatherer {
 public:
  Gatherer(const Solution& solution, const SolutionErrors& errors, double accuracy, std::uint64_t seed)
      : solution_(solution),
        errors_(errors),
        rays_(solution, seed),
        bodies_(solution, rays_.emitters()),
        first_rays_(first_rays(accuracy)),
        many_rays_(solution.scene().sky.has_sun() ? kManyRaysUnderSun : kManyRays),
        luminaires_(any_luminaires(solution.scene())) {
    for (const Opening& opening : scene().openings) opening_ends_.push_back(shaft_end(opening));
  }

  /// @param at  the sensor, lifted off what it may stand on
  /// @param roughly  with the fewest rays
  [[nodiscard]] SensorState begin(std::size_t sensor, const Point& at, const Receiver& receiver, bool roughly) const {
    SensorState state;
    const std::uint32_t rays = roughly ? 1 : first_rays_;
    GroupSums exact(scene().groups);
    for (const std::uint32_t k : bodies_.others()) see_emitter(k, rays, sensor, at, receiver, state, exact);
    for (const LampBody& body : bodies_.bodies()) see_body(body, rays, sensor, at, receiver, state, exact);
    const AreaMean by_luminaires = luminaire_illuminance(scene(), luminaires_, at, receiver, kFineMean, 1.0, exact);
    state.exact_lux += by_luminaires.value;
    see_sun(rays, sensor, at, receiver, state, exact);
    state.exact = exact.lit();
    for (std::uint32_t k = 0; k < scene().openings.size(); ++k) see_opening(k, roughly, sensor, at, receiver, state);
    Part hemisphere;
    extend(hemisphere, rays, sensor, at, receiver);
    // Where next to nothing is met, the light may come through a small hole: a few rays would call it dark, and be sure of it.
    while (!roughly && hemisphere.lit() < kReplicates / 2 && hemisphere.rays < kMostDarkRays) {
      extend(hemisphere, 2 * hemisphere.rays, sensor, at, receiver);
    }
    state.parts.push_back(hemisphere);
    state.luminaires_lux = by_luminaires.error;
    settle_discretisation(state);
    return state;
  }

  /// Samples on until the accuracy is kept, or it is time to finish. What it allows follows the light as it gets known: the first few rays may
  /// have found far too much.
  /// @param dark_lux  darker sensors need not be better than those of so much light
  template <class ShouldFinish>
  void improve(SensorState& state, double accuracy, double dark_lux, std::size_t sensor, const Point& at,
               const Receiver& receiver, const ShouldFinish& should_finish) const {
    double allowed_lux = accuracy * std::max(state.mean(), dark_lux);
    for (Part& p : state.parts) {
      if (is_dark_opening(p) && std::sqrt(p.variance()) > kNeglected * allowed_lux && !should_finish())
        look_into(p, sensor, at, receiver);
    }
    const double clear_goal = kClearShare * sampling_goal(state, allowed_lux);
    for (Part& p : state.parts) {
      while (p.clear && !should_finish() && p.rays < kMostClearRays &&
             kStudent * std::sqrt(p.variance()) > clear_goal) {
        extend(p, 2 * p.rays, sensor, at, receiver);
      }
    }
    while (state.cautious_error(many_rays_) > sampling_goal(state, allowed_lux) && !should_finish()) {
      // The part whose doubling takes off most for a ray.
      Part* best = nullptr;
      double most = 0.0;
      for (Part& p : state.parts) {
        const double gain = p.variance() / p.rays;
        if (p.rays < (p.lit() > 0 ? kMostRays : kMostDarkRays) && gain > most) {
          most = gain;
          best = &p;
        }
      }
      if (best == nullptr) return;
      if (is_dark_opening(*best) && !best->looked_at)
        look_into(*best, sensor, at, receiver);
      else
        extend(*best, 2 * best->rays, sensor, at, receiver);
      settle_discretisation(state);
      allowed_lux = accuracy * std::max(state.mean(), dark_lux);
    }
  }

 private:
  [[nodiscard]] const Scene& scene() const { return solution_.scene(); }

  static bool faces_opening(const Opening& opening, const Point& at, const Receiver& receiver) {
    if (dot(opening.triangles[0][0] - at, opening.outward) <= 0.0) return false;
    for (const auto& t : opening.triangles) {
      for (const Point& p : t) {
        if (receiver.kernel(p - at) > 0.0) return true;
      }
    }
    return false;
  }

  void extend(Part& part, std::uint32_t until, std::size_t sensor, const Point& at, const Receiver& receiver) const {
    PartTaker taker{&solution_, &errors_, &part};
    rays_.cast(part, until, {sensor, at, receiver}, taker);
    part.rays = until;
  }

  void see_sun(std::uint32_t rays, std::size_t sensor, const Point& at, const Receiver& receiver, SensorState& state,
               GroupSums& exact) const {
    const Sun& sun = scene().sky.sun;
    if (!sun.shines()) return;
    if (!sun.disc) {
      const double lux = sun_illuminance(scene(), at, receiver);
      state.exact_lux += lux;
      exact.add(scene().groups.of_sun(), lux);
      return;
    }
    Part part;
    part.kind = Part::Kind::kSun;
    extend(part, std::max(4U, rays), sensor, at, receiver);
    state.parts.push_back(part);
  }

  /// Facet by facet where something may stand before the body.
  void see_body(const LampBody& body, std::uint32_t rays, std::size_t sensor, const Point& at, const Receiver& receiver,
                SensorState& state, GroupSums& exact) const {
    const mesh::ShaftEnd eye = mesh::point_end(at);
    const BodySight sight = bodies_.sight(solution_, body, eye);
    if (sight == BodySight::kHidden) return;
    for (const BodyFacet& facet : body.facets) {
      if (sight == BodySight::kClear)
        add_exact(rays_.emitters()[facet.emitter], full_factor(solution_, rays_.emitters(), facet, at, receiver), state,
                  exact);
      else
        see_emitter(facet.emitter, rays, sensor, at, receiver, state, exact);
    }
  }

  void add_exact(const Emitter& emitter, double factor, SensorState& state, GroupSums& exact) const {
    state.exact_lux += emitter.exitance * factor;
    exact.add(scene().side_group[solution_.tree().face_side(emitter.root).index()], emitter.exitance * factor);
  }

  void see_emitter(std::uint32_t k, std::uint32_t rays, std::size_t sensor, const Point& at, const Receiver& receiver,
                   SensorState& state, GroupSums& exact) const {
    const Emitter& emitter = rays_.emitters()[k];
    const double full = full_factor(solution_, emitter, at, receiver);
    const SeenFactor seen = seen_factor(solution_, emitter, full, at, receiver);
    if (seen.exact) {
      add_exact(emitter, seen.factor, state, exact);
      return;
    }
    Part part;
    part.kind = Part::Kind::kEmitter;
    part.which = k;
    part.full_lux = emitter.exitance * full;
    part.most_lux = emitter.exitance * seen.factor;
    extend(part, std::max(8U, rays), sensor, at, receiver);
    state.parts.push_back(part);
  }

  [[nodiscard]] std::uint32_t rays_through() const { return std::max(4U, first_rays_); }

  /// Many openings, of which most are of other rooms: one ray a replicate tells, and must do where there is no time for more.
  void see_opening(std::uint32_t k, bool roughly, std::size_t sensor, const Point& at, const Receiver& receiver,
                   SensorState& state) const {
    const Opening& opening = scene().openings[k];
    if (!faces_opening(opening, at, receiver)) return;
    Part part;
    part.kind = Part::Kind::kOpening;
    part.which = k;
    extend(part, 1, sensor, at, receiver);
    if (part.lit() == 0)
      part.most_lux = full_through(scene(), opening_ends_[k], at, receiver);
    else if (!roughly)
      extend(part, rays_through(), sensor, at, receiver);
    const mesh::ShaftEnd eye = mesh::point_end(at);
    part.clear = part.lit() > 0 && scene().shafts->classify(eye, opening_ends_[k]) == Visibility::kVisible;
    state.parts.push_back(part);
  }

  static bool is_dark_opening(const Part& part) { return part.kind == Part::Kind::kOpening && part.lit() == 0; }

  /// Clips a dark opening by what stands before it; what is not hidden gets more rays.
  void look_into(Part& part, std::size_t sensor, const Point& at, const Receiver& receiver) const {
    part.looked_at = true;
    part.most_lux = most_through(scene(), opening_ends_[part.which], at, receiver);
    if (part.most_lux > 0.0 && part.rays < rays_through()) extend(part, rays_through(), sensor, at, receiver);
  }

  /// What the solution's errors make at a sensor, by all surfaces that its rays have met: errors of far elements cancel out only over many
  /// rays.
  static void settle_discretisation(SensorState& state) {
    ErrorSums wrong{};
    for (const Part& part : state.parts) {
      const double norm = std::accumulate(part.norms.begin(), part.norms.end(), 0.0);
      if (norm <= 0.0) continue;
      for (std::size_t k = 0; k < wrong.size(); ++k) wrong[k] += part.wrong[k] / norm;
    }
    state.discretisation_lux = std::hypot(error_of(wrong), state.luminaires_lux);
  }

  const Solution& solution_;
  const SolutionErrors& errors_;
  SensorRays rays_;
  LampBodies bodies_;
  std::uint32_t first_rays_;
  double many_rays_;
  std::vector<mesh::ShaftEnd> opening_ends_;
  std::vector<LuminaireView> luminaires_;
};

/// Calls body(sensor, should_finish) for all sensors, a batch at a time; should_finish() tells whether the time of the batch is over.
template <class Body>
void for_sensors(std::size_t count, Progress& progress, const Body& body) {
  constexpr std::size_t kBatch = 256;  // between two signs of life
  for (std::size_t first = 0; first < count; first += kBatch) {
    const std::size_t end = std::min(first + kBatch, count);
    const double until = static_cast<double>(end) / static_cast<double>(count);
    const auto should_finish = [&] { return progress.should_finish(until); };
    parallel_for(end - first, [&](std::size_t k) { body(first + k, should_finish); });
    progress.advance(until);
  }
}

}  // namespace

Gathered gather(const Solution& solution, const SolutionErrors& errors, const SensorSet& sensors, double accuracy,
                std::uint64_t seed, Progress& progress) {
  const std::size_t count = sensors.count();
  const Gatherer gatherer(solution, errors, accuracy, seed);
  std::vector<Point> lifted(count);
  for (std::size_t i = 0; i < count; ++i)
    lifted[i] = sensors.positions[i] + solution.scene().rays->offset_m() * sensors.axes[i];
  std::vector<SensorState> states(count);
  PhasePart beginning(progress, 0.0, kShareOfBeginnings);
  for_sensors(count, beginning, [&](std::size_t i, const auto& should_finish) {
    states[i] = gatherer.begin(i, lifted[i], sensors.receiver(i), should_finish());
  });
  double mean = 0.0;
  for (const SensorState& s : states) mean += s.mean() / static_cast<double>(count);
  PhasePart improving(progress, kShareOfBeginnings, 1.0);
  for_sensors(count, improving, [&](std::size_t i, const auto& should_finish) {
    gatherer.improve(states[i], accuracy, kDarkShare * mean, i, lifted[i], sensors.receiver(i), should_finish);
  });
  Gathered result;
  for (const SensorState& s : states) {
    const double sampling = s.sampling_error();
    result.illuminance_lux.push_back(static_cast<float>(s.mean()));
    result.error_lux.push_back(static_cast<float>(std::hypot(sampling, s.discretisation_lux)));
    const ReplicateMean around = s.parts.back().estimate();
    result.indirect_lux.push_back(static_cast<float>(around.mean));
    result.indirect_error_lux.push_back(
        static_cast<float>(std::hypot(kStudent * around.standard_error(), s.discretisation_lux)));
    if (!solution.scene().groups.has_columns()) continue;
    SensorRecord record;
    record.parts.assign(s.parts.begin(), s.parts.end());
    record.exact = s.exact;
    record.discretisation_lux = static_cast<float>(s.discretisation_lux);
    result.records.push_back(std::move(record));
  }
  return result;
}

}  // namespace clerestory::lighting
