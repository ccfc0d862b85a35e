// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sky.h"

#include <numbers>

namespace clerestory::lighting {

double sky_luminance(const Sky& sky, const mesh::Vector& direction) {
  if (sky.type == Sky::Type::kNone) return 0.0;
  const double horizontal = sky.horizontal_illuminance_lux;
  if (direction.z < 0.0) return sky.ground_reflectance * horizontal / std::numbers::pi;
  if (sky.type == Sky::Type::kUniform) return horizontal / std::numbers::pi;
  const double zenith = 9.0 * horizontal / (7.0 * std::numbers::pi);
  return zenith * (1.0 + 2.0 * direction.z) / 3.0;
}

}  // namespace clerestory::lighting
