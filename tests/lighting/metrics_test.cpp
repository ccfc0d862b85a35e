// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "lighting/grids.h"

namespace clerestory::lighting {
namespace {

GridResult grid(std::vector<float> values, std::vector<float> errors) {
  GridResult result;
  result.illuminance_lux = std::move(values);
  result.error_lux = std::move(errors);
  return result;
}

TEST(GridMetrics, FiguresOfFourSensors) {
  const GridMetrics m = grid_metrics(grid({400, 100, 200, 500}, {4, 1, 2, 5}), 0.02);
  EXPECT_DOUBLE_EQ(m.mean_lux, 300);
  EXPECT_DOUBLE_EQ(m.median_lux, 300);
  EXPECT_DOUBLE_EQ(m.minimum_lux, 100);
  EXPECT_DOUBLE_EQ(m.maximum_lux, 500);
  EXPECT_NEAR(m.uniformity, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(m.accuracy_reached, 0.01, 1e-12);
  EXPECT_TRUE(m.accuracy_met);
  EXPECT_FALSE(m.has_daylight_factor);
  EXPECT_DOUBLE_EQ(grid_metrics(grid({3, 9, 5}, {0, 0, 0}), 0.02).median_lux, 5);
}

TEST(GridMetrics, DarkSensorsCountAgainstFivePerCentOfTheMean) {
  // Mean 50: the dark sensor's error of 0.1 lx counts against 2.5 lx.
  const GridMetrics m = grid_metrics(grid({100, 0}, {0, 0.1F}), 0.02);
  EXPECT_NEAR(m.accuracy_reached, 0.04 / std::sqrt(2.0), 1e-8);
}

TEST(GridMetrics, MoreThanOneInTwentyBeyondTwiceTheTargetIsNotMet) {
  std::vector<float> values(40, 100.0F);
  std::vector<float> errors(40, 0.1F);
  errors[0] = errors[1] = 4.1F;
  EXPECT_TRUE(grid_metrics(grid(values, errors), 0.02).accuracy_met);
  errors[2] = 4.1F;
  const GridMetrics m = grid_metrics(grid(values, errors), 0.02);
  EXPECT_LT(m.accuracy_reached, 0.02);
  EXPECT_DOUBLE_EQ(m.share_within_twice, 37.0 / 40.0);
  EXPECT_FALSE(m.accuracy_met);
}

TEST(GridMetrics, AllZeroGridHasMetAnyAccuracy) {
  const GridMetrics m = grid_metrics(grid({0, 0, 0}, {0, 0, 0}), 0.02);
  EXPECT_EQ(m.accuracy_reached, 0.0);
  EXPECT_EQ(m.uniformity, 0.0);
  EXPECT_TRUE(m.accuracy_met);
  EXPECT_FALSE(grid_metrics(grid({0, 0}, {1, 1}), 0.02).accuracy_met);
}

TEST(GridMetrics, DaylightFactorsOfTwoAndFivePerCentAreCountedInclusively) {
  GridResult g = grid({100, 200, 500, 1000}, {0, 0, 0, 0});
  g.daylight_factor_percent = {1, 2, 5, 10};
  const GridMetrics m = grid_metrics(g, 0.02);
  EXPECT_TRUE(m.has_daylight_factor);
  EXPECT_DOUBLE_EQ(m.mean_df_percent, 4.5);
  EXPECT_DOUBLE_EQ(m.median_df_percent, 3.5);
  EXPECT_DOUBLE_EQ(m.minimum_df_percent, 1.0);
  EXPECT_DOUBLE_EQ(m.share_above_2_percent, 0.75);
  EXPECT_DOUBLE_EQ(m.share_above_5_percent, 0.5);
}

TEST(Metrics, AGridIsAsGoodAsTheWorstOfItsColumns) {
  GridResult cylindrical = grid({200, 400}, {1, 2});
  cylindrical.cylindrical_lux = {100, 300};
  cylindrical.cylindrical_error_lux = {3, 9};
  const GridMetrics m = grid_metrics(cylindrical, 0.02);
  EXPECT_DOUBLE_EQ(m.mean_cylindrical_lux, 200.0);
  EXPECT_DOUBLE_EQ(m.mean_modelling, 0.625);
  EXPECT_NEAR(m.accuracy_reached, 0.03, 1e-6);
  EXPECT_FALSE(m.accuracy_met);
}

}  // namespace
}  // namespace clerestory::lighting
