// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/glazing.h"

#include <cmath>

namespace clerestory::lighting {

namespace {

constexpr double kIndex = 1.52;

struct Split {
  double transmitted = 0.0;
  double reflected = 0.0;
};

/// One sheet with transmissivity t (the share that passes one crossing at normal incidence) for one Fresnel reflectance r.
/// T = (1−r)² a / (1−r² a²), R = r (1 + (1−2r) a²) / (1−r² a²), a = t^(1/cos θ').
Split sheet(double r, double a) {
  const double below = 1.0 - r * r * a * a;
  return {(1.0 - r) * (1.0 - r) * a / below, r * (1.0 + (1.0 - 2.0 * r) * a * a) / below};
}

/// Two layers in series, with all reflections between them.
Split in_series(const Split& first, const Split& second) {
  const double below = 1.0 - first.reflected * second.reflected;
  return {first.transmitted * second.transmitted / below,
          first.reflected + first.transmitted * first.transmitted * second.reflected / below};
}

Split stack(Split one, int panes) {
  Split all = one;
  for (int i = 1; i < panes; ++i) all = in_series(all, one);
  return all;
}

/// Both polarisations of a unit at one angle.
Split unit_at(double cosine, double transmissivity, int panes) {
  if (cosine <= 0.0) return {0.0, 1.0};
  const double inner = std::sqrt(1.0 - (1.0 - cosine * cosine) / (kIndex * kIndex));
  const double s = (cosine - kIndex * inner) / (cosine + kIndex * inner);
  const double p = (kIndex * cosine - inner) / (kIndex * cosine + inner);
  const double a = std::pow(transmissivity, 1.0 / inner);
  const Split one = stack(sheet(s * s, a), panes);
  const Split two = stack(sheet(p * p, a), panes);
  return {0.5 * (one.transmitted + two.transmitted), 0.5 * (one.reflected + two.reflected)};
}

/// The transmissivity that gives a unit its normal transmittance, by bisection: T grows with t. At most 1.
double transmissivity_for(double transmittance_normal, int panes) {
  if (unit_at(1.0, 1.0, panes).transmitted <= transmittance_normal) return 1.0;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (unit_at(1.0, middle, panes).transmitted < transmittance_normal ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// 2 ∫ f(cos) cos d cos over the curve, trapezoid by its own table.
double hemispherical(const mesh::TransmittanceCurve& curve) {
  constexpr int kSteps = 4096;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps;
    sum += mesh::transmittance_at(curve, static_cast<float>(cosine)) * cosine;
  }
  return 2.0 * sum / kSteps;
}

}  // namespace

GlazingCurves glazing_curves(double transmittance_normal, int panes) {
  const double t = transmissivity_for(transmittance_normal, panes);
  const double scale = t < 1.0 ? 1.0 : transmittance_normal / unit_at(1.0, 1.0, panes).transmitted;
  GlazingCurves curves;
  const std::size_t last = curves.transmittance.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const Split split = unit_at(static_cast<double>(i) / static_cast<double>(last), t, panes);
    const double transmitted = scale * split.transmitted;
    curves.transmittance[i] = static_cast<float>(transmitted);
    curves.reflectance[i] = static_cast<float>(std::min(split.reflected, 1.0 - transmitted));
  }
  curves.hemispherical_transmittance = hemispherical(curves.transmittance);
  curves.hemispherical_reflectance = hemispherical(curves.reflectance);
  return curves;
}

}  // namespace clerestory::lighting
