// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/ugr_table.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/lamps.h"

namespace clerestory::lighting {
namespace {

const LuminousOpening kPanel{.shape = LuminousOpening::Shape::kRectangle, .x_m = 0.6, .y_m = 0.6};

TEST(UgrBackground, NoFluxIsLostAndTransfersAreThoseOfCie190) {
  const auto lamp = test::lambertian_lamp({}, {0, 0, -1}, 100.0);
  const UgrBackground b = ugr_background(*lamp.web, {4, 8}, {0.7, 0.5, 0.2});
  EXPECT_NEAR(b.to_floor + b.to_walls + b.to_ceiling, 1.0, 1e-4);
  EXPECT_EQ(b.to_ceiling, 0.0);
  // CIE 190:2010, table 5, for a room index of 2.67.
  EXPECT_NEAR(b.transfer[0], 0.115, 0.005);
  EXPECT_NEAR(b.transfer[1], 0.211, 0.005);
  EXPECT_NEAR(b.transfer[2], 0.307, 0.005);
}

TEST(UgrBackground, OfALambertianCeilingComesToTheFloorByTheFormFactor) {
  const auto lamp = test::lambertian_lamp({}, {0, 0, -1}, 100.0);
  // Facing squares of two sides' length at distance 1: Howell C-11.
  EXPECT_NEAR(ugr_background(*lamp.web, {2, 2}, {0, 0, 0}).to_floor, 0.415253, 2e-4);
  EXPECT_EQ(ugr_background(*lamp.web, {2, 2}, {0, 0, 0}).on_walls(), 0.0);
}

TEST(UgrTable, RisesWithTheFluxByItsLogarithm) {
  const auto dim = test::lambertian_lamp({}, {0, 0, -1}, 100.0);
  const auto bright = test::lambertian_lamp({}, {0, 0, -1}, 1000.0);
  const UgrTable a = ugr_table(*dim.web, kPanel, true);
  const UgrTable b = ugr_table(*bright.web, kPanel, true);
  for (std::size_t r = 0; r < a.size(); ++r) {
    for (std::size_t f = 0; f < a[r].size(); ++f) EXPECT_NEAR(b[r][f] - a[r][f], 8.0, 1e-9);
  }
}

TEST(UgrTable, OfARoundLuminaireIsAlikeFromBothSides) {
  const auto lamp = test::lambertian_lamp({}, {0, 0, -1}, 1000.0);
  const UgrTable table = ugr_table(*lamp.web, kPanel, false);
  for (const auto& row : table) {
    for (std::size_t f = 0; f < 5; ++f) EXPECT_NEAR(row[f], row[f + 5], 1e-9);
  }
}

}  // namespace
}  // namespace clerestory::lighting
