// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminous_opening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lighting/photometric_web.h"

namespace clerestory::lighting {
namespace {

using Shape = LuminousOpening::Shape;
using std::numbers::pi;

TEST(LuminousOpening, FlatOnesAreSeenByTheCosine) {
  const LuminousOpening panel{.shape = Shape::kRectangle, .x_m = 0.3, .y_m = 1.2};
  const LuminousOpening disc{.shape = Shape::kEllipse, .x_m = 0.2, .y_m = 0.2};
  EXPECT_NEAR(panel.projected_area_m2(direction_at(35, 60)), 0.18, 1e-12);
  EXPECT_NEAR(disc.projected_area_m2(direction_at(35, 60)), 0.005 * pi, 1e-12);
  EXPECT_NEAR(panel.projected_area_m2(direction_at(35, 90)), 0.0, 1e-12);
}

TEST(LuminousOpening, SidesAreSeenByTheirOwnHeights) {
  const LuminousOpening box{
      .shape = Shape::kRectangle, .x_m = 0.3, .y_m = 1.2, .z_m = 0.1, .sides_m = {0.1, 0.05, 0.0, 0.02}};
  EXPECT_NEAR(box.projected_area_m2({1, 0, 0}), 0.12, 1e-12);
  EXPECT_NEAR(box.projected_area_m2({0, 1, 0}), 0.015, 1e-12);
  EXPECT_NEAR(box.projected_area_m2({-1, 0, 0}), 0.0, 1e-12);
  EXPECT_NEAR(box.projected_area_m2({0, -1, 0}), 0.006, 1e-12);
  const LuminousOpening drum{
      .shape = Shape::kEllipse, .x_m = 0.4, .y_m = 0.4, .z_m = 0.1, .sides_m = {0.1, 0.1, 0.1, 0.1}};
  for (const double c : {0.0, 20.0, 45.0}) EXPECT_NEAR(drum.projected_area_m2(direction_at(c, 90)), 0.04, 1e-12);
}

TEST(LuminousOpening, BodiesAreSeenAsTheirShadows) {
  const LuminousOpening sphere{.shape = Shape::kEllipsoid, .x_m = 0.5, .y_m = 0.5, .z_m = 0.5};
  for (const double gamma : {0.0, 40.0, 130.0})
    EXPECT_NEAR(sphere.projected_area_m2(direction_at(77, gamma)), pi / 16, 1e-12);
  const LuminousOpening tube{.shape = Shape::kCylinderAlongX, .x_m = 1.5, .y_m = 0.04, .z_m = 0.04};
  EXPECT_NEAR(tube.projected_area_m2({1, 0, 0}), pi / 4 * 0.0016, 1e-12);
  EXPECT_NEAR(tube.projected_area_m2(direction_at(90, 33)), 0.06, 1e-12);
  const LuminousOpening across{.shape = Shape::kCylinderAlongY, .x_m = 0.04, .y_m = 1.5, .z_m = 0.04};
  EXPECT_NEAR(across.projected_area_m2({1, 0, 0}), 0.06, 1e-12);
  const LuminousOpening wall{.shape = Shape::kUprightDisc, .y_m = 0.2, .z_m = 0.2};
  EXPECT_NEAR(wall.projected_area_m2({1, 0, 0}), 0.01 * pi, 1e-12);
  EXPECT_EQ(wall.projected_area_m2({0, 0, -1}), 0.0);
}

TEST(LuminousOpening, APointHasNoAreaAndNoSize) {
  EXPECT_FALSE(LuminousOpening{}.has_area());
  EXPECT_EQ(LuminousOpening{}.size_m(), 0.0);
  EXPECT_EQ(LuminousOpening{}.projected_area_m2({0, 0, -1}), 0.0);
}

}  // namespace
}  // namespace clerestory::lighting
