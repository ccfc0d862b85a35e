// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sampled_mean.h"

#include <gtest/gtest.h>

#include <vector>

namespace clerestory::lighting {
namespace {

double square(const SobolPoints& points, std::uint32_t i) { return points.at(i, 0) * points.at(i, 0); }

TEST(SampledMean, DoublesItsSetsUntilTheErrorIsSmall) {
  const auto mean_to = [](double error) {
    return sampled_mean(7, 4, 1024, square,
                        [&](const ReplicateMean& mean, std::uint32_t) { return mean.standard_error() <= error; });
  };
  const SampledMean rough = mean_to(1e-2);
  const SampledMean fine = mean_to(1e-4);
  EXPECT_LT(rough.samples, fine.samples);
  EXPECT_LE(fine.standard_error(), 1e-4);
  EXPECT_NEAR(fine.mean, 1.0 / 3.0, 4e-4);
}

TEST(SampledMean, StopsAtTheMostAndTakesNoPointTwice) {
  std::uint32_t taken = 0;
  std::vector<std::uint32_t> counts;
  const SampledMean mean = sampled_mean(
      7, 4, 32,
      [&](const SobolPoints& points, std::uint32_t i) {
        ++taken;
        return square(points, i);
      },
      [&](const ReplicateMean&, std::uint32_t count) {
        counts.push_back(count);
        return false;
      });
  EXPECT_EQ(mean.samples, 8U * 32U);
  EXPECT_EQ(taken, mean.samples);
  EXPECT_EQ(counts, (std::vector<std::uint32_t>{4, 8, 16}));
}

}  // namespace
}  // namespace clerestory::lighting
