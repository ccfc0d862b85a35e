// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sky.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace clerestory::lighting {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr mesh::Vector kZenith{0.0, 0.0, 1.0};

double ground_luminance(const Sky& sky) {
  if (sky.type != Sky::Type::kSum) return sky.ground_reflectance * sky.ground_illuminance_lux() / kPi;
  double sum = 0.0;
  for (const Sky& part : sky.parts) sum += ground_luminance(part);
  return sum;
}

void scale(Sky& sky, double share) {
  sky.horizontal_illuminance_lux *= share;
  sky.luminance_scale *= share;
  sky.sun.normal_illuminance_lux *= share;
  sky.share = share;
}

}  // namespace

bool Sky::has_sun() const {
  bool any = false;
  for_suns([&](const Sun& one) { any = any || one.shines(); });
  return any;
}

double Sky::ground_illuminance_lux() const {
  if (type == Type::kSum) {
    double sum = 0.0;
    for (const Sky& part : parts) sum += part.ground_illuminance_lux();
    return sum;
  }
  return diffuse_illuminance_lux() + (sun.shines() ? sun.normal_illuminance_lux * sun.towards.z : 0.0);
}

Sky sky_of(const SkyDistribution& distribution, double horizontal_illuminance_lux) {
  Sky sky;
  sky.type = Sky::Type::kDistribution;
  sky.horizontal_illuminance_lux = horizontal_illuminance_lux;
  sky.distribution = distribution;
  sky.luminance_scale = horizontal_illuminance_lux / relative_horizontal_illuminance(distribution);
  return sky;
}

Sky mean_sky(std::vector<Sky> moments) {
  double of_inverses = 0.0;
  for (const Sky& moment : moments) {
    if (moment.ground_illuminance_lux() > 0.0) of_inverses += 1.0 / moment.ground_illuminance_lux();
  }
  Sky mean;
  mean.type = Sky::Type::kSum;
  mean.horizontal_illuminance_lux = 0.0;
  for (Sky& moment : moments) {
    const double lux = moment.ground_illuminance_lux();
    scale(moment, lux > 0.0 ? 1.0 / (lux * of_inverses) : 0.0);
    mean.horizontal_illuminance_lux += moment.diffuse_illuminance_lux();
  }
  mean.parts = std::move(moments);
  return mean;
}

double horizontal_illuminance_of(const Sky& sky, double zenith_luminance_cd_m2) {
  switch (sky.type) {
    case Sky::Type::kNone:
      return 0.0;
    case Sky::Type::kUniform:
      return kPi * zenith_luminance_cd_m2;
    case Sky::Type::kCieOvercast:
      return 7.0 * kPi / 9.0 * zenith_luminance_cd_m2;
    case Sky::Type::kDistribution:
      return zenith_luminance_cd_m2 * relative_horizontal_illuminance(sky.distribution) /
             relative_luminance(sky.distribution, kZenith);
    case Sky::Type::kSum:
      break;  // of its parts' own zeniths
  }
  return 0.0;
}

double sky_luminance(const Sky& sky, const mesh::Vector& direction) {
  if (direction.z < 0.0) return ground_luminance(sky);
  switch (sky.type) {
    case Sky::Type::kNone:
      return 0.0;
    case Sky::Type::kUniform:
      return sky.horizontal_illuminance_lux / kPi;
    case Sky::Type::kCieOvercast:
      return 9.0 * sky.horizontal_illuminance_lux / (7.0 * kPi) * (1.0 + 2.0 * direction.z) / 3.0;
    case Sky::Type::kDistribution:
      return sky.luminance_scale * relative_luminance(sky.distribution, direction);
    case Sky::Type::kSum: {
      double sum = 0.0;
      for (const Sky& part : sky.parts) sum += sky_luminance(part, direction);
      return sum;
    }
  }
  return 0.0;
}

double sky_luminance_bound(const Sky& sky) {
  if (sky.type == Sky::Type::kSum) {
    double sum = 0.0;
    for (const Sky& part : sky.parts) sum += sky_luminance_bound(part);
    return sum;
  }
  const double above = sky.type == Sky::Type::kDistribution
                           ? sky.luminance_scale * relative_luminance_bound(sky.distribution)
                           : sky_luminance(sky, kZenith);
  return std::max(above, ground_luminance(sky));
}

}  // namespace clerestory::lighting
