// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/linear_fit.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace clerestory::lighting {
namespace {

/// Samples of 3 + 2u − v about their own centroid, with a disturbance of changing sign.
std::vector<PlaneSample> plane_samples(double disturbance) {
  std::vector<PlaneSample> samples;
  double sign = 1.0;
  for (const double u : {-1.5, -0.5, 0.5, 1.5}) {
    for (const double v : {-0.5, 0.5}) {
      samples.push_back({u, v, 3.0 + 2.0 * u - v + sign * disturbance, 0.125});
      sign = -sign;
    }
    sign = -sign;
  }
  return samples;
}

TEST(LinearFit, RecoversAPlane) {
  const LinearFit fit = fit_line(plane_samples(0.0));
  EXPECT_FLOAT_EQ(fit.line.value, 3.0F);
  EXPECT_FLOAT_EQ(fit.line.slope_u, 2.0F);
  EXPECT_FLOAT_EQ(fit.line.slope_v, -1.0F);
  EXPECT_NEAR(fit.residual, 0.0, 1e-7);
}

TEST(LinearFit, HeavySamplesCountMore) {
  const std::vector<PlaneSample> samples{{-1, -1, 1, 0.4}, {1, -1, 3, 0.4}, {-1, 1, 1, 0.1}, {1, 1, 3, 0.1}};
  const LinearFit fit = fit_line(samples);
  EXPECT_FLOAT_EQ(fit.line.value, 2.0F);
  EXPECT_FLOAT_EQ(fit.line.slope_u, 1.0F);
  EXPECT_NEAR(fit.line.slope_v, 0.0, 1e-6);
}

TEST(LinearFit, ResidualIsTheNoisePerDegreeOfFreedom) {
  // Over many fits the squared residual has the noise's variance as its mean.
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.25);
  constexpr int kFits = 2000;
  double square = 0.0;
  for (int i = 0; i < kFits; ++i) {
    auto samples = plane_samples(0.0);
    for (PlaneSample& s : samples) s.value += noise(random);
    const double r = fit_line(samples).residual;
    square += r * r / kFits;
  }
  EXPECT_NEAR(square, 0.0625, 4.0 * 0.0625 * std::sqrt(2.0 / 5.0 / kFits));
}

TEST(LinearFit, SlopesInMuchNoiseAreRightOnTheAverage) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 8.0);
  constexpr int kFits = 4000;
  double mean = 0.0;
  for (int i = 0; i < kFits; ++i) {
    auto samples = plane_samples(0.0);
    for (PlaneSample& s : samples) s.value += noise(random);
    mean += fit_line(samples).line.slope_u / kFits;
  }
  // A slope has a standard error of 8 / sqrt(8 · 1.25).
  EXPECT_NEAR(mean, 2.0, 4.0 * 8.0 / std::sqrt(10.0 * kFits));
}

TEST(LinearFit, SamplesInARowGiveTheirMean) {
  std::vector<PlaneSample> row;
  for (const double u : {-1.5, -0.5, 0.5, 1.5}) row.push_back({u, 2.0 * u, u, 0.25});
  const LinearFit fit = fit_line(row);
  EXPECT_NEAR(fit.line.value, 0.0, 1e-7);
  EXPECT_EQ(fit.line.slope_u, 0.0F);
  EXPECT_NEAR(fit.residual, std::sqrt(5.0 / 3.0), 1e-6);
}

TEST(LinearFit, FewSamplesGiveTheirMean) {
  const std::vector<PlaneSample> three{{0, 0, 1, 0.5}, {1, 0, 2, 0.25}, {0, 1, 3, 0.25}};
  const LinearFit fit = fit_line(three);
  EXPECT_FLOAT_EQ(fit.line.value, 1.75F);
  EXPECT_EQ(fit.line.slope_u, 0.0F);
  const std::vector<PlaneSample> one{{0, 0, 7, 1.0}};
  EXPECT_EQ(fit_line(one).line.value, 7.0F);
  EXPECT_EQ(fit_line(one).residual, 0.0);
}

}  // namespace
}  // namespace clerestory::lighting
