// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/web_sampler.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lighting/sampling.h"

namespace clerestory::lighting {
namespace {

/// Means over many directions: of the weights, and of the weighted cosine against γ = 0 and to C0.
struct Means {
  double weight = 0.0;
  double down = 0.0;
  double to_c0 = 0.0;
};

Means means_of(const PhotometricWeb& web) {
  constexpr std::uint32_t kCount = 1U << 14U;
  const WebSampler sampler(web);
  const SobolPoints points(7);
  Means means;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const WebSample s = sampler.sample(points.at(i, 0), points.at(i, 1));
    means.weight += s.weight / kCount;
    means.down -= s.weight * s.direction.z / kCount;
    means.to_c0 += s.weight * s.direction.x / kCount;
  }
  return means;
}

TEST(WebSampler, OfALambertianLampFollowsTheCosine) {
  IntensityGrid grid;
  for (int gamma = 0; gamma <= 90; ++gamma) {
    grid.polar_deg.push_back(gamma);
    grid.candela.push_back(100.0 * std::cos(gamma * M_PI / 180.0));
  }
  grid.azimuth_deg = {0.0};
  const Means means = means_of(PhotometricWeb(grid));
  EXPECT_NEAR(means.weight, 1.0, 1e-3);
  EXPECT_NEAR(means.down, 2.0 / 3.0, 1e-3);
  EXPECT_NEAR(means.to_c0, 0.0, 1e-3);
}

TEST(WebSampler, OfANarrowBeamThatIsAskewStaysInIt) {
  // Within 10 degrees of γ = 0, and twice as strong towards C0 as away from it.
  IntensityGrid grid;
  grid.polar_deg = {0.0, 5.0, 10.0};
  grid.azimuth_deg = {0.0, 180.0};
  grid.candela = {300.0, 200.0, 0.0, 300.0, 100.0, 0.0};
  const PhotometricWeb web(grid);
  const Means means = means_of(web);
  EXPECT_NEAR(means.weight, 1.0, 1e-3);
  EXPECT_GT(means.down, std::cos(10.0 * M_PI / 180.0));
  // The exact integral of intensity · direction, by fine midpoints.
  double flux = 0.0;
  double to_c0 = 0.0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double gamma = 10.0 * (i + 0.5) / kSteps;
      const double c = 360.0 * (j + 0.5) / kSteps;
      const double part = web.intensity_cd(c, gamma) * std::sin(gamma * M_PI / 180.0);
      flux += part;
      to_c0 += part * direction_at(c, gamma).x;
    }
  }
  EXPECT_NEAR(means.to_c0, to_c0 / flux, 2e-4);
}

}  // namespace
}  // namespace clerestory::lighting
