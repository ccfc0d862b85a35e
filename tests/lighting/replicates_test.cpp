// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/replicates.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace clerestory::lighting {
namespace {

TEST(Replicates, TheVarianceIsTheOneOfTheMean) {
  const ReplicateMean r = mean_of_replicates(std::array{1.0, 3.0, 5.0, 7.0});
  EXPECT_DOUBLE_EQ(r.mean, 4.0);
  EXPECT_DOUBLE_EQ(r.variance, 20.0 / (4.0 * 3.0));
  EXPECT_DOUBLE_EQ(r.standard_error(), std::sqrt(5.0 / 3.0));
}

TEST(Replicates, EqualEstimatesHaveNoErrorHoweverLargeTheyAre) {
  const ReplicateMean r = mean_of_replicates(std::array{1e9 + 0.1, 1e9 + 0.1, 1e9 + 0.1, 1e9 + 0.1});
  EXPECT_EQ(r.mean, 1e9 + 0.1);
  EXPECT_EQ(r.variance, 0.0);
}

TEST(Replicates, TheVarianceOfManyDrawsHasTheRightMean) {
  // The mean of sixteen draws from [0, 1) has the variance 1/(12·16). An estimate of that has, by the draws' kurtosis of 1.8, a
  // relative variance of (1.8 − 13/15)/16, so that the mean of 20,000 has a relative standard error of 0.0017; four are allowed.
  constexpr int kTrials = 20000;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> draw(0.0, 1.0);
  double mean = 0.0;
  for (int t = 0; t < kTrials; ++t) {
    std::array<double, 16> draws{};
    for (double& d : draws) d = draw(random);
    mean += mean_of_replicates(draws).variance / kTrials;
  }
  const double expected = 1.0 / (12.0 * 16.0);
  EXPECT_NEAR(mean, expected, 4.0 * 0.0017 * expected);
}

}  // namespace
}  // namespace clerestory::lighting
