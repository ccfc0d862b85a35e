// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/glare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace clerestory::lighting {

using mesh::Vector;

double position_index(const View& view, const Vector& direction) {
  constexpr double kPerRadian = 180.0 / std::numbers::pi;
  const double ahead = dot(direction, view.direction);
  const Vector beside = direction - ahead * view.direction;
  const double off = norm(beside);
  const double sigma = std::atan2(off, ahead) * kPerRadian;
  // The part of "up" that is across the line of sight: the vertical from which τ is counted.
  const Vector vertical = normalized(view.up - dot(view.up, view.direction) * view.direction);
  const double tau =
      off > 0.0 ? std::acos(std::clamp(std::abs(dot(beside, vertical)) / off, 0.0, 1.0)) * kPerRadian : 0.0;
  const double linear = 35.2 - 0.31889 * tau - 1.22 * std::exp(-2.0 * tau / 9.0);
  const double square = 21.0 + 0.26667 * tau - 0.002963 * tau * tau;
  return std::exp(1e-3 * linear * sigma + 1e-5 * square * sigma * sigma);
}

double unified_glare_rating(const View& view, std::span<const GlareSource> sources, double background_cd_m2) {
  double sum = 0.0;
  for (const GlareSource& source : sources) {
    if (dot(source.direction, view.direction) <= 0.0) continue;
    const double p = position_index(view, source.direction);
    sum += source.luminance_cd_m2 * source.luminance_cd_m2 * source.solid_angle_sr / (p * p);
  }
  if (sum <= 0.0 || background_cd_m2 <= 0.0) return -std::numeric_limits<double>::infinity();
  return 8.0 * std::log10(0.25 * sum / background_cd_m2);
}

}  // namespace clerestory::lighting
