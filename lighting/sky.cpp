// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sky.h"

#include <algorithm>
#include <numbers>

namespace clerestory::lighting {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr mesh::Vector kZenith{0.0, 0.0, 1.0};

double ground_luminance(const Sky& sky) { return sky.ground_reflectance * sky.ground_illuminance_lux() / kPi; }

}  // namespace

double Sky::ground_illuminance_lux() const {
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
  }
  return 0.0;
}

double sky_luminance_bound(const Sky& sky) {
  const double above = sky.type == Sky::Type::kDistribution
                           ? sky.luminance_scale * relative_luminance_bound(sky.distribution)
                           : sky_luminance(sky, kZenith);
  return std::max(above, ground_luminance(sky));
}

}  // namespace clerestory::lighting
