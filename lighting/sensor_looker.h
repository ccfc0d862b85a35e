// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "lighting/light_paths.h"
#include "lighting/sky.h"
#include "lighting/solution.h"
#include "lighting/solution_errors.h"

namespace clerestory::lighting {

/// What light may be wrong by in each of the samples of a solution's errors [lux].
using ErrorSums = std::array<double, SolutionErrors::kSamples>;

/// The error that the samples tell [lux]: twice it keeps 97 %, by Student's t for so few of them.
inline double error_of(const ErrorSums& wrong_lux) {
  constexpr double kStudentOfSamples = 2.63 / 2.0;
  double square = 0.0;
  for (const double lux : wrong_lux) square += lux * lux / static_cast<double>(wrong_lux.size());
  return kStudentOfSamples * std::sqrt(square);
}

/// Adds up the light along a sensor's ray, a visitor of follow().
struct SensorLooker {
  const Solution* solution;
  const SolutionErrors* errors;
  double lux = 0.0;
  ErrorSums wrong{};  ///< what the light of surfaces may be wrong by

  void surface(const SurfacePoint& seen, float weight, bool with_emission) {
    const mesh::ElementId e = solution->element_at(seen.side, seen.region, seen.at);
    if (!e.valid()) return;
    lux += static_cast<double>(weight) * solution->luminous_radiosity_at(e, seen.at, with_emission);
    const SolutionErrors::Samples samples = errors->radiosity(*solution, e, seen.at);
    for (std::size_t k = 0; k < samples.size(); ++k) wrong[k] += static_cast<double>(weight) * samples[k];
  }
  void sky(const mesh::Vector& direction, float weight, bool) {
    lux += weight * std::numbers::pi * sky_luminance(solution->scene().sky, direction);
  }
};

}  // namespace clerestory::lighting
