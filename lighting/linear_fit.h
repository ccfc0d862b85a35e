// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "lighting/solution.h"

namespace clerestory::lighting {

/// A value at a point of a plane, by its coordinates from the centroid of what is fitted; weights add up to 1.
struct PlaneSample {
  double u = 0.0;
  double v = 0.0;
  double value = 0.0;
  double weight = 0.0;
};

struct LinearFit {
  LinearValue line;       ///< mean of the values, and slopes
  double residual = 0.0;  ///< RMS of what the line misses, per degree of freedom
};

/// Weighted least-squares plane; the constant where the samples do not span one. Noisy slopes are kept as they are: weak ones dropped, many
/// pieces side by side would all be too flat.
inline LinearFit fit_line(std::span<const PlaneSample> samples) {
  double mu = 0.0;
  double mv = 0.0;
  double mean = 0.0;
  for (const PlaneSample& s : samples) {
    mu += s.weight * s.u;
    mv += s.weight * s.v;
    mean += s.weight * s.value;
  }
  double uu = 0.0;
  double uv = 0.0;
  double vv = 0.0;
  double uf = 0.0;
  double vf = 0.0;
  double ff = 0.0;
  for (const PlaneSample& s : samples) {
    const double u = s.u - mu;
    const double v = s.v - mv;
    const double f = s.value - mean;
    uu += s.weight * u * u;
    uv += s.weight * u * v;
    vv += s.weight * v * v;
    uf += s.weight * u * f;
    vf += s.weight * v * f;
    ff += s.weight * f * f;
  }
  const auto n = static_cast<double>(samples.size());
  LinearFit fit;
  fit.line.value = static_cast<float>(mean);
  fit.residual = samples.size() > 1 ? std::sqrt(ff * n / (n - 1.0)) : 0.0;
  const double determinant = uu * vv - uv * uv;
  if (samples.size() < 4 || determinant <= 1e-9 * (uu + vv) * (uu + vv)) return fit;
  const double gu = (uf * vv - vf * uv) / determinant;
  const double gv = (vf * uu - uf * uv) / determinant;
  const double left = std::max(0.0, ff - gu * uf - gv * vf);
  fit.line.slope_u = static_cast<float>(gu);
  fit.line.slope_v = static_cast<float>(gv);
  fit.residual = std::sqrt(left * n / (n - 3.0));
  return fit;
}

}  // namespace clerestory::lighting
