// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map_scale.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace clerestory::io {
namespace {

using Values = std::vector<float>;
using Knots = std::vector<double>;

Values between(double low, double high) {
  Values values;
  for (int i = 0; i <= 1000; ++i) values.push_back(static_cast<float>(low * std::pow(high / low, i / 1000.0)));
  return values;
}

TEST(MapScale, DaylightFactorsTakeTheFamiliarSteps) {
  const MapScale scale = choose_scale(between(0.35, 11.0), MapQuantity::kDaylightFactor);
  EXPECT_EQ(scale.isolines, (Knots{0.5, 1, 2, 3, 5, 10}));
  EXPECT_EQ(scale.knots, (Knots{0.3, 0.5, 1, 2, 3, 5, 10, 20}));
}

TEST(MapScale, IlluminancesTakeTheStepsOfTheLightingStandard) {
  const MapScale scale = choose_scale(between(80, 1400), MapQuantity::kIlluminance);
  EXPECT_EQ(scale.isolines, (Knots{100, 200, 300, 500, 750, 1000}));
}

TEST(MapScale, NarrowRangesTakeEvenSteps) {
  const MapScale scale = choose_scale(between(481, 529), MapQuantity::kIlluminance);
  EXPECT_EQ(scale.isolines, (Knots{490, 500, 510, 520}));
  EXPECT_EQ(scale.knots.front(), 480);
  EXPECT_EQ(scale.knots.back(), 530);
}

TEST(MapScale, WideRangesKeepTheNumberOfLinesReadable) {
  for (const double low : {1e-3, 0.1, 3.0, 99.0}) {
    for (const double high : {100.0, 1234.0, 1e5}) {
      for (const MapQuantity quantity : {MapQuantity::kDaylightFactor, MapQuantity::kIlluminance}) {
        const MapScale scale = choose_scale(between(low, high), quantity);
        EXPECT_LE(scale.isolines.size(), 9U) << low << " … " << high;
        EXPECT_TRUE(std::ranges::is_sorted(scale.knots));
        EXPECT_LE(scale.knots.front(), low);
        EXPECT_GE(scale.knots.back(), high);
      }
    }
  }
}

TEST(MapScale, OneBrightSensorDoesNotTakeTheScaleFromTheRoom) {
  Values values = between(50, 400);
  values.push_back(5000.0F);
  EXPECT_GE(choose_scale(values, MapQuantity::kIlluminance).position(400.0), 0.4);
}

TEST(MapScale, ValuesThatAreAllAlikeGetNoLine) {
  for (const float value : {0.0F, 0.003F, 4.97F, 500.0F}) {
    const MapScale scale = choose_scale(Values(100, value), MapQuantity::kIlluminance);
    EXPECT_TRUE(scale.isolines.empty()) << value;
    EXPECT_LT(scale.knots.front(), scale.knots.back()) << value;
    EXPECT_LE(scale.knots.front(), static_cast<double>(value));
    EXPECT_GE(scale.knots.back(), static_cast<double>(value));
  }
}

TEST(MapScale, PositionAndValueAreInverse) {
  const MapScale scale = choose_scale(between(0.35, 11.0), MapQuantity::kDaylightFactor);
  for (const double value : {0.3, 0.4, 1.0, 2.7, 10.0, 19.9})
    EXPECT_NEAR(scale.value(scale.position(value)), value, 1e-12);
  EXPECT_EQ(scale.position(0.0), 0.0);
  EXPECT_EQ(scale.position(99.0), 1.0);
}

TEST(MapColour, GetsLighterAllTheWay) {
  double last = -1.0;
  for (int i = 0; i <= 200; ++i) {
    const double now = lightness(map_colour(i / 200.0));
    EXPECT_GE(now, last) << i;
    last = now;
  }
  EXPECT_LT(lightness(map_colour(0.0)), 0.15);
  EXPECT_GT(lightness(map_colour(1.0)), 0.9);
}

TEST(MapNumber, HasTwoOrThreeSignificantDigits) {
  EXPECT_EQ(map_number(0.0), "0");
  EXPECT_EQ(map_number(0.0123), "0.012");
  EXPECT_EQ(map_number(0.394), "0.39");
  EXPECT_EQ(map_number(2.34), "2.3");
  EXPECT_EQ(map_number(9.96), "10");
  EXPECT_EQ(map_number(1026.4), "1026");
  EXPECT_EQ(knot_label(0.3), "0.3");
  EXPECT_EQ(knot_label(15000.0), "15000");
}

}  // namespace
}  // namespace clerestory::io
