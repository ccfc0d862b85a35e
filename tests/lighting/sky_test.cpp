// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clerestory::lighting {
namespace {

/// Illuminance of a horizontal surface by the sky, midpoint rule in sin γ [lux].
double horizontal_illuminance(const Sky& sky) {
  constexpr int kSteps = 10'000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double sine = (i + 0.5) / kSteps;
    sum += sky_luminance(sky, {std::sqrt(1.0 - sine * sine), 0.0, sine}) * sine;
  }
  return 2.0 * std::numbers::pi * sum / kSteps;
}

TEST(Sky, TheOvercastSkyGivesItsHorizontalIlluminance) {
  EXPECT_NEAR(horizontal_illuminance({.type = Sky::Type::kCieOvercast, .horizontal_illuminance_lux = 12'345.0}),
              12'345.0, 1e-3);
}

TEST(Sky, TheUniformSkyGivesItsHorizontalIlluminance) {
  EXPECT_NEAR(horizontal_illuminance({.type = Sky::Type::kUniform, .horizontal_illuminance_lux = 8'000.0}), 8'000.0,
              1e-3);
}

TEST(Sky, TheOvercastZenithIsThreeTimesAsBrightAsTheHorizon) {
  const Sky sky;
  const double zenith = sky_luminance(sky, {0.0, 0.0, 1.0});
  EXPECT_NEAR(zenith, 9.0 * 10'000.0 / (7.0 * std::numbers::pi), 1e-9);
  EXPECT_NEAR(sky_luminance(sky, {0.0, 1.0, 0.0}), zenith / 3.0, 1e-9);
  EXPECT_NEAR(sky_luminance(sky, {0.0, std::sqrt(0.75), 0.5}), zenith * 2.0 / 3.0, 1e-9);
}

TEST(Sky, BelowTheHorizonLiesTheGround) {
  EXPECT_NEAR(sky_luminance({.ground_reflectance = 0.3}, {0.6, 0.0, -0.8}), 0.3 * 10'000.0 / std::numbers::pi, 1e-9);
}

TEST(Sky, TheGroundSeesTheSunThatShines) {
  Sky sky{.ground_reflectance = 0.3};
  sky.sun = {.towards = {0.0, 0.6, 0.8}, .normal_illuminance_lux = 50'000.0};
  EXPECT_NEAR(sky_luminance(sky, {0.6, 0.0, -0.8}), 0.3 * (10'000.0 + 40'000.0) / std::numbers::pi, 1e-9);
  EXPECT_NEAR(sky_luminance(sky, {0.0, 0.6, 0.8}), sky_luminance({}, {0.0, 0.6, 0.8}), 1e-9);
  sky.sun.towards = {0.0, 0.8, -0.6};
  EXPECT_NEAR(sky_luminance(sky, {0.6, 0.0, -0.8}), 0.3 * 10'000.0 / std::numbers::pi, 1e-9);
}

TEST(Sky, ADistributionGivesItsHorizontalIlluminanceAndItsZenith) {
  const mesh::Vector sun{0.0, 0.6, 0.8};
  for (int type = 1; type <= 15; ++type) {
    Sky sky = sky_of(cie_general_sky(type, sun), 20'000.0);
    const double zenith = sky_luminance(sky, {0.0, 0.0, 1.0});
    EXPECT_NEAR(horizontal_illuminance_of(sky, zenith), 20'000.0, 1e-6) << type;
    EXPECT_LE(sky_luminance(sky, sun), sky_luminance_bound(sky)) << type;
  }
}

TEST(Sky, TheZenithFixesTheHorizontalIlluminance) {
  EXPECT_NEAR(horizontal_illuminance_of({.type = Sky::Type::kUniform}, 1000.0), 1000.0 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(horizontal_illuminance_of({.type = Sky::Type::kCieOvercast}, 9000.0), 7000.0 * std::numbers::pi, 1e-9);
  EXPECT_EQ(horizontal_illuminance_of({.type = Sky::Type::kNone}, 9000.0), 0.0);
}

TEST(Sky, NoSkyIsBlackAndLightsNoGround) {
  EXPECT_EQ(sky_luminance({.type = Sky::Type::kNone}, {0.0, 0.0, 1.0}), 0.0);
  EXPECT_EQ(sky_luminance({.type = Sky::Type::kNone}, {0.0, 0.0, -1.0}), 0.0);
}

Sky with_sun(Sky sky, const mesh::Vector& towards, double lux) {
  sky.sun = {.towards = towards, .normal_illuminance_lux = lux};
  return sky;
}

TEST(Sky, InTheMeanOfMomentsEachGivesTheOpenGroundTheSame) {
  const mesh::Vector low{0.0, 0.8, 0.6};
  Sky bright = with_sun(sky_of(cie_general_sky(12, low), 20'000.0), low, 50'000.0);
  bright.moment = "noon";
  Sky dim{.horizontal_illuminance_lux = 5'000.0};
  const Sky night{.type = Sky::Type::kNone};
  const Sky mean = mean_sky({bright, dim, night});
  ASSERT_EQ(mean.parts.size(), 3U);
  EXPECT_EQ(mean.parts[0].moment, "noon");
  EXPECT_NEAR(mean.parts[0].share + mean.parts[1].share, 1.0, 1e-12);
  EXPECT_EQ(mean.parts[2].share, 0.0);
  EXPECT_NEAR(mean.parts[0].ground_illuminance_lux(), mean.parts[1].ground_illuminance_lux(), 1e-9);
  EXPECT_NEAR(mean.parts[0].ground_illuminance_lux(), mean.parts[0].share * 50'000.0, 1e-9);
}

TEST(Sky, TheLightOfASumIsThatOfItsParts) {
  const mesh::Vector low{0.0, 0.8, 0.6};
  const Sky bright = with_sun(sky_of(cie_general_sky(12, low), 20'000.0), low, 50'000.0);
  const Sky dim{.horizontal_illuminance_lux = 5'000.0};
  const Sky mean = mean_sky({bright, dim});
  for (const mesh::Vector& direction : {low, mesh::Vector{0.6, 0.0, 0.8}, mesh::Vector{0.0, 0.6, -0.8}}) {
    const double expected =
        mean.parts[0].share * sky_luminance(bright, direction) + mean.parts[1].share * sky_luminance(dim, direction);
    EXPECT_NEAR(sky_luminance(mean, direction), expected, 1e-9 * expected);
    EXPECT_LE(sky_luminance(mean, direction), sky_luminance_bound(mean));
  }
  EXPECT_NEAR(mean.diffuse_illuminance_lux(), mean.parts[0].share * 20'000.0 + mean.parts[1].share * 5'000.0, 1e-9);
  EXPECT_TRUE(mean.has_sun());
  EXPECT_FALSE(mean_sky({dim, dim}).has_sun());
}

}  // namespace
}  // namespace clerestory::lighting
