// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lighting/direct_light.h"
#include "lighting/form_factor.h"
#include "lighting/light_paths.h"
#include "lighting/opening_sampler.h"
#include "lighting/parallel.h"
#include "lighting/sampling.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

using mesh::ElementId;
using mesh::FaceSide;
using mesh::Point;
using mesh::Vector;
using mesh::Visibility;

namespace {

/// Independent scramblings of the same points: their spread is the error's estimate.
constexpr std::size_t kReplicates = 16;
/// Student's t with 15 degrees of freedom keeps 95.45 % within 2.18 standard errors of the mean; the stated error is so much larger
/// that twice the error keeps them.
constexpr double kStudent = 2.18 / 2.0;
/// The share of the accuracy that sampling may use up; discretisation has the rest.
constexpr double kSamplingShare = 0.6;
constexpr std::uint32_t kFirstOpening = 4;      ///< rays a replicate to begin with
constexpr std::uint32_t kFirstHemisphere = 16;
constexpr std::uint32_t kMostRays = 4096;       ///< a replicate and part
/// Sensors darker than this share of the grid's mean need not be better than one of that illuminance.
constexpr double kDarkShare = 0.05;

using Replicates = std::array<double, kReplicates>;

/// One part of a sensor's light: sums over its rays, a replicate each.
struct Part {
  std::int32_t opening = -1;  ///< -1: the hemisphere
  std::uint32_t rays = 0;     ///< a replicate
  Replicates sums{};

  [[nodiscard]] double mean() const {
    double sum = 0.0;
    for (const double s : sums) sum += s;
    return rays > 0 ? sum / (static_cast<double>(rays) * kReplicates) : 0.0;
  }
  /// Of the mean.
  [[nodiscard]] double variance() const {
    const double m = mean();
    double square = 0.0;
    for (const double s : sums) {
      const double d = s / rays - m;
      square += d * d;
    }
    return square / (kReplicates * (kReplicates - 1.0));
  }
};

/// A surface that shines, as the sensors see it.
struct Emitter {
  ElementId root;
  double exitance = 0.0;  ///< [lm/m²]
  mesh::ShaftEnd end;
};

struct SensorState {
  std::vector<Part> parts;
  double exact_lux = 0.0;           ///< proven views of emitters, point sources
  double partial_variance = 0.0;    ///< of emitters seen in part
  double discretisation_lux = 0.0;  ///< error that the solution's own errors make here

  [[nodiscard]] double mean() const {
    double sum = exact_lux;
    for (const Part& p : parts) sum += p.mean();
    return sum;
  }
  [[nodiscard]] double sampling_error() const {
    double sum = partial_variance;
    for (const Part& p : parts) sum += p.variance();
    return kStudent * std::sqrt(sum);
  }
};

/// Adds up the light along a ray.
struct Looker {
  const Solution* solution;
  double lux = 0.0;
  std::vector<std::pair<std::uint32_t, float>>* met = nullptr;  ///< elements with weights, where asked for

  void surface(FaceSide side, const Point& at, float weight, bool with_emission) {
    const ElementId e = solution->element_at(side, at);
    if (!e.valid()) return;
    const Scene& scene = solution->scene();
    float b = 0.0F;
    for (std::size_t c = 0; c < scene.channels; ++c) {
      b += scene.channel_weights[c] * solution->radiosity_at(e, at, c, with_emission);
    }
    lux += static_cast<double>(weight) * b;
    if (met != nullptr) met->emplace_back(e.value, weight);
  }
  void sky(const Vector& direction, float weight) {
    lux += weight * std::numbers::pi * sky_luminance(solution->scene().sky, direction);
  }
};

class Gatherer {
 public:
  Gatherer(const Solution& solution, std::uint64_t seed) : solution_(solution), seed_(seed) {
    for (const ElementId root : solution.tree().roots()) {
      const auto exitance = scene().side_exitance(solution.tree().face_side(root));
      const double m = luminance(exitance, scene().channel_weights);
      if (m <= 0.0) continue;
      Emitter emitter{root, m, {}};
      emitter.end.count = solution.tree().hull(root, emitter.end.corners);
      emitter.end.normal = solution.tree().normal(root);
      emitters_.push_back(emitter);
    }
  }

  [[nodiscard]] SensorState begin(std::size_t sensor, const Point& at, const Vector& normal) const {
    SensorState state;
    for (const Emitter& emitter : emitters_) see_emitter(emitter, mesh::hash(seed_, sensor), at, normal, state);
    for (const PointSource& source : scene().point_sources) {
      float passed = 0.0F;
      const mesh::Segment segment{at, source.at};
      scene().rays->transmittance({&segment, 1}, {&passed, 1});
      state.exact_lux += passed * point_illuminance(source, at, normal);
    }
    for (std::size_t k = 0; k < scene().openings.size(); ++k) {
      if (!faces_opening(scene().openings[k], at, normal)) continue;
      Part part;
      part.opening = static_cast<std::int32_t>(k);
      extend(part, kFirstOpening, sensor, at, normal, nullptr);
      if (part.mean() > 0.0) state.parts.push_back(part);
    }
    Part hemisphere;
    std::vector<std::pair<std::uint32_t, float>> met;
    extend(hemisphere, kFirstHemisphere, sensor, at, normal, &met);
    state.parts.push_back(hemisphere);
    state.discretisation_lux = discretisation(met, kFirstHemisphere * kReplicates);
    return state;
  }

  /// Samples on until the error is under the goal [lux].
  void improve(SensorState& state, double goal_lux, std::size_t sensor, const Point& at, const Vector& normal) const {
    while (state.sampling_error() > goal_lux) {
      // The part whose doubling takes off most for a ray.
      Part* best = nullptr;
      double most = 0.0;
      for (Part& p : state.parts) {
        const double gain = p.variance() / p.rays;
        if (p.rays < kMostRays && gain > most) {
          most = gain;
          best = &p;
        }
      }
      if (best == nullptr) return;
      extend(*best, 2 * best->rays, sensor, at, normal, nullptr);
    }
  }

 private:
  [[nodiscard]] const Scene& scene() const { return solution_.scene(); }

  static bool faces_opening(const Opening& opening, const Point& at, const Vector& normal) {
    if (dot(opening.triangles[0][0] - at, opening.outward) <= 0.0) return false;
    for (const auto& t : opening.triangles) {
      for (const Point& p : t) {
        if (dot(p - at, normal) > 0.0) return true;
      }
    }
    return false;
  }

  void extend(Part& part, std::uint32_t until, std::size_t sensor, const Point& at, const Vector& normal,
              std::vector<std::pair<std::uint32_t, float>>* met) const {
    const std::uint64_t key = mesh::hash(mesh::hash(seed_, sensor), static_cast<std::uint64_t>(part.opening + 2));
    if (part.opening < 0) {
      const mesh::Frame frame = mesh::frame_around(normal);
      for (std::size_t r = 0; r < kReplicates; ++r) {
        const SobolPoints points(mesh::hash(key, r));
        for (std::uint32_t i = part.rays; i < until; ++i) {
          Looker looker{&solution_, 0.0, met};
          const Vector d = cosine_direction(frame, points.at(i, 0), points.at(i, 1));
          follow(scene(), at, d, 1.0F, PathRule{PathRule::Part::kGather, -1, true}, looker);
          part.sums[r] += looker.lux;
        }
      }
    } else {
      const OpeningSampler sampler(at, scene().openings[static_cast<std::size_t>(part.opening)].triangles);
      for (std::size_t r = 0; r < kReplicates; ++r) {
        const SobolPoints points(mesh::hash(key, r));
        for (std::uint32_t i = part.rays; i < until; ++i) {
          const SolidAngleSample s = sampler.sample(points.at(i, 0), points.at(i, 1));
          const double cosine = dot(s.direction, normal);
          if (cosine <= 0.0 || s.solid_angle_sr <= 0.0) continue;
          Looker looker{&solution_, 0.0, nullptr};
          follow(scene(), at, s.direction, 1.0F, PathRule{PathRule::Part::kOpening, part.opening, true}, looker);
          part.sums[r] += looker.lux * s.solid_angle_sr * cosine / std::numbers::pi;
        }
      }
    }
    part.rays = until;
  }

  void see_emitter(const Emitter& emitter, std::uint64_t key, const Point& at, const Vector& normal,
                   SensorState& state) const {
    const mesh::ElementTree& tree = solution_.tree();
    std::array<mesh::OutlineEdge, 3> scratch;
    const double factor = point_form_factor(at, normal, tree.outline(emitter.root, scratch), emitter.end.normal);
    if (factor <= 0.0) return;
    const mesh::ShaftEnd own{.corners = {at}, .count = 1, .normal = {}};
    const Visibility visibility = scene().shafts->classify(own, emitter.end);
    if (visibility == Visibility::kHidden) return;
    const double full = emitter.exitance * factor;
    if (visibility == Visibility::kVisible) {
      state.exact_lux += full;
      return;
    }
    constexpr std::uint32_t kRays = 64;  // a replicate: 1,024 in all
    Part part;
    part.rays = 1;
    for (std::size_t r = 0; r < kReplicates; ++r) {
      part.sums[r] = full * visible_share(emitter, mesh::hash(mesh::hash(key, emitter.root.value), r), kRays, at, normal);
    }
    state.exact_lux += part.mean();
    state.partial_variance += part.variance();
  }

  /// The kernel-weighted share of an emitter that a sensor sees.
  [[nodiscard]] double visible_share(const Emitter& emitter, std::uint64_t key, std::uint32_t rays, const Point& at,
                                     const Vector& normal) const {
    const SobolPoints points(key);
    double seen = 0.0;
    double all = 0.0;
    for (std::uint32_t i = 0; i < rays; ++i) {
      const Point q = solution_.tree().sample(emitter.root, points.at(i, 0), points.at(i, 1));
      const Vector to = q - at;
      const double distance2 = dot(to, to);
      const double kernel = std::max(0.0, dot(to, normal)) * std::max(0.0, -dot(to, emitter.end.normal)) /
                            (distance2 * distance2);
      if (kernel <= 0.0) continue;
      const mesh::Segment segment{at, q + scene().rays->offset_m() * emitter.end.normal};
      float passed = 0.0F;
      scene().rays->transmittance({&segment, 1}, {&passed, 1});
      seen += kernel * passed;
      all += kernel;
    }
    return all > 0.0 ? seen / all : 0.0;
  }

  /// Errors of different elements are independent: their weighted squares add up.
  [[nodiscard]] double discretisation(std::vector<std::pair<std::uint32_t, float>>& met, std::size_t rays) const {
    std::sort(met.begin(), met.end());
    double square = 0.0;
    for (std::size_t i = 0; i < met.size();) {
      const std::uint32_t e = met[i].first;
      double weight = 0.0;
      for (; i < met.size() && met[i].first == e; ++i) weight += met[i].second;
      const mesh::FaceSide side = solution_.tree().face_side(ElementId(e));
      const float rho = luminance(scene().side_reflectance(side), scene().channel_weights);
      const double own = weight / static_cast<double>(rays) * rho * solution_.element_error(ElementId(e));
      square += own * own;
    }
    return std::sqrt(square);
  }

  const Solution& solution_;
  std::uint64_t seed_;
  std::vector<Emitter> emitters_;
};

}  // namespace

Gathered gather(const Solution& solution, std::span<const Point> positions, std::span<const Vector> normals,
                double accuracy, std::uint64_t seed, Progress& progress) {
  const std::size_t count = positions.size();
  const Gatherer gatherer(solution, seed);
  std::vector<SensorState> states(count);
  parallel_for(count, [&](std::size_t i) { states[i] = gatherer.begin(i, positions[i], normals[i]); });
  double mean = 0.0;
  for (const SensorState& s : states) mean += s.mean() / static_cast<double>(count);

  constexpr std::size_t kBatch = 256;  // sensors between two signs of life
  for (std::size_t first = 0; first < count; first += kBatch) {
    const std::size_t batch = std::min(kBatch, count - first);
    parallel_for(batch, [&](std::size_t k) {
      const std::size_t i = first + k;
      const double level = std::max(states[i].mean(), kDarkShare * mean);
      gatherer.improve(states[i], kSamplingShare * accuracy * level, i, positions[i], normals[i]);
    });
    progress.advance(static_cast<double>(first + batch) / static_cast<double>(count));
  }

  Gathered result;
  for (const SensorState& s : states) {
    const double sampling = s.sampling_error();
    result.illuminance_lux.push_back(static_cast<float>(s.mean()));
    result.error_lux.push_back(static_cast<float>(std::hypot(sampling, s.discretisation_lux)));
  }
  return result;
}

}  // namespace clerestory::lighting
