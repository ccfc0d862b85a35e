// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sky_patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clerestory::lighting {
namespace {

TEST(SkyPatches, ThereAre145OfTregenzaAnd577OfReinhart) {
  EXPECT_EQ(SkyPatches(1).count(), 145U);
  EXPECT_EQ(SkyPatches(2).count(), 577U);
}

TEST(SkyPatches, TheirSolidAnglesAddUpToTheHemisphere) {
  for (const std::size_t parts : {1U, 2U}) {
    const SkyPatches patches(parts);
    double sum = 0.0;
    for (std::size_t p = 0; p < patches.count(); ++p) sum += patches.solid_angle_sr(p);
    EXPECT_NEAR(sum, 2.0 * std::numbers::pi, 1e-12);
  }
}

TEST(SkyPatches, ADirectionInAPatchIsFoundThere) {
  for (const std::size_t parts : {1U, 2U}) {
    const SkyPatches patches(parts, 37.0);
    for (std::size_t p = 0; p < patches.count(); ++p) {
      for (const double a : {0.01, 0.5, 0.99}) {
        for (const double b : {0.01, 0.5, 0.99}) EXPECT_EQ(patches.of(patches.direction(p, a, b)), p);
      }
      EXPECT_EQ(patches.of(patches.centre(p)), p);
    }
  }
}

TEST(SkyPatches, TheFirstLooksNorthAndTheNextOnesGoEast) {
  const SkyPatches patches;
  const mesh::Vector first = patches.centre(0);
  EXPECT_NEAR(first.x, 0.0, 1e-12);
  EXPECT_NEAR(std::asin(first.z) * 180.0 / std::numbers::pi, 6.0, 0.05);
  EXPECT_GT(patches.centre(1).x, 0.0);
  EXPECT_EQ(patches.of({0.0, 0.0, 1.0}), 144U);
}

TEST(SkyPatches, NorthTurnsThemAll) {
  const SkyPatches patches(1, 90.0);  // north is -x
  EXPECT_LT(patches.centre(0).x, -0.9);
  EXPECT_EQ(patches.of({-0.99, 0.0, std::sqrt(1.0 - 0.99 * 0.99)}), 0U);
}

}  // namespace
}  // namespace clerestory::lighting
