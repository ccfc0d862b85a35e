// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "lighting/emitters.h"
#include "lighting/light_paths.h"
#include "lighting/opening_sampler.h"
#include "lighting/receiver.h"
#include "lighting/sampling.h"
#include "lighting/solution.h"
#include "lighting/sun_light.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

/// Independent scramblings of the same points: their spread is the error's estimate.
inline constexpr std::size_t kReplicates = 16;
/// Student's t with 15 degrees of freedom keeps 97 % within 2.40 standard errors of the mean; the stated error is so much larger that twice
/// the error keeps them: 95 % are promised of each grid, also where chance is against it.
inline constexpr double kStudent = 2.40 / 2.0;

/// A part of a sensor's light that has rays of its own.
struct SensorPart {
  enum class Kind { kHemisphere, kOpening, kEmitter, kSun };

  Kind kind = Kind::kHemisphere;
  std::uint32_t which = 0;  ///< opening or emitter
  std::uint32_t rays = 0;   ///< a replicate
  double full_lux = 0.0;    ///< of an emitter, if all of it were seen
  double most_lux = 0.0;    ///< of an emitter or a dark opening, if all were seen that is not proven hidden
};

/// Where a sensor stands, lifted off what it may stand on; local coordinates.
struct SensorPlace {
  std::size_t number = 0;
  mesh::Point at;
  Receiver receiver;
};

/// The rays of sensors: the same ones whenever they are asked for.
class SensorRays {
 public:
  SensorRays(const Solution& solution, std::uint64_t seed)
      : solution_(solution), seed_(seed), emitters_(lighting::emitters(solution)) {}

  [[nodiscard]] const std::vector<Emitter>& emitters() const { return emitters_; }

  /// Casts the rays from number part.rays up to `until` of each replicate. For a ray, the taker gets
  ///   ray(replicate, trace, scale), with trace(visitor) following it and scale(lux) giving what it is worth in the part's sum,
  ///   each counting 1; miss(replicate) for one that can see nothing, which counts too;
  ///   sun(replicate, lux) for one to the sun, which counts 1 as well;
  ///   or, of an emitter, seen(replicate, kernel, passed): the part's sum is of full_lux · kernel · passed, over that of the kernels.
  template <class Taker>
  void cast(const SensorPart& part, std::uint32_t until, const SensorPlace& place, Taker& taker) const {
    const std::uint64_t key =
        mesh::hash(mesh::hash(seed_, place.number), mesh::hash(static_cast<std::uint64_t>(part.kind), part.which));
    for (std::size_t r = 0; r < kReplicates; ++r) {
      const SobolPoints points(mesh::hash(key, r));
      switch (part.kind) {
        case SensorPart::Kind::kHemisphere:
          look_around(part, r, until, points, place, taker);
          break;
        case SensorPart::Kind::kOpening:
          look_out(part, r, until, points, place, taker);
          break;
        case SensorPart::Kind::kEmitter:
          look_at_emitter(part, r, until, points, place, taker);
          break;
        case SensorPart::Kind::kSun:
          look_at_sun(part, r, until, points, place, taker);
          break;
      }
    }
  }

 private:
  [[nodiscard]] const Scene& scene() const { return solution_.scene(); }

  template <class Taker>
  void look_around(const SensorPart& part, std::size_t r, std::uint32_t until, const SobolPoints& points,
                   const SensorPlace& place, Taker& taker) const {
    const mesh::Frame frame = mesh::frame_around(place.receiver.axis());
    for (std::uint32_t i = part.rays; i < until; ++i) {
      const auto [a, b] = points.point<2>(i);
      const mesh::Vector d = place.receiver.direction(frame, a, b);
      taker.ray(
          r,
          [&](auto& visitor) {
            follow(scene(), place.at, d, 1.0F, PathRule{PathRule::Part::kGather, -1, true}, visitor);
          },
          [](double lux) { return lux; });
    }
  }

  template <class Taker>
  void look_out(const SensorPart& part, std::size_t r, std::uint32_t until, const SobolPoints& points,
                const SensorPlace& place, Taker& taker) const {
    const OpeningSampler sampler(place.at, scene().openings[part.which].triangles);
    const PathRule rule{PathRule::Part::kOpening, static_cast<std::int32_t>(part.which), true};
    for (std::uint32_t i = part.rays; i < until; ++i) {
      const auto [a, b] = points.point<2>(i);
      const SolidAngleSample s = sampler.sample(a, b);
      const double kernel = place.receiver.kernel(s.direction);
      if (kernel <= 0.0 || s.solid_angle_sr <= 0.0) {
        taker.miss(r);
        continue;
      }
      taker.ray(
          r, [&](auto& visitor) { follow(scene(), place.at, s.direction, 1.0F, rule, visitor); },
          [&](double lux) { return lux * s.solid_angle_sr * kernel / std::numbers::pi; });
    }
  }

  template <class Taker>
  void look_at_emitter(const SensorPart& part, std::size_t r, std::uint32_t until, const SobolPoints& points,
                       const SensorPlace& place, Taker& taker) const {
    for (std::uint32_t i = part.rays; i < until; ++i) {
      const auto [a, b] = points.point<2>(i);
      const EmitterSample seen = sample(solution_, emitters_[part.which], place.at, place.receiver, a, b);
      taker.seen(r, seen.kernel, seen.passed);
    }
  }

  template <class Taker>
  void look_at_sun(const SensorPart& part, std::size_t r, std::uint32_t until, const SobolPoints& points,
                   const SensorPlace& place, Taker& taker) const {
    for (std::uint32_t i = part.rays; i < until; ++i) {
      const Sun& sun = scene().sky.sun;
      const auto [a, b] = points.point<2>(i);
      const mesh::Vector towards = sun_direction(sun, a, b);
      taker.sun(r, sun_illuminance(scene(), sun, place.at, place.receiver, towards));
    }
  }

  const Solution& solution_;
  std::uint64_t seed_;
  std::vector<Emitter> emitters_;
};

}  // namespace clerestory::lighting
