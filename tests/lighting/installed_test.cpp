// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/installed.h"

#include <gtest/gtest.h>

#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

Study lamp_room() {
  Study study = test::study_of(support::box_room(4, 5, 3), 0.5, {2, 2, 1});
  for (const double y : {1.0, 2.0, 4.0}) {
    Luminaire lamp = clerestory::test::isotropic_lamp({2, y, 2.8}, 100.0);
    lamp.name = "ball.ies";
    lamp.power_w = 20.0;
    lamp.group = y < 3.0 ? "front" : "back";
    study.luminaires.push_back(lamp);
  }
  return study;
}

TEST(Installed, LuminairesAreListedByKindAndGroup) {
  const test::Stage stage(lamp_room());
  const auto uses = luminaire_uses(stage.scene);
  ASSERT_EQ(uses.size(), 2U);
  EXPECT_EQ(uses[0].group, "front");
  EXPECT_EQ(uses[0].count, 2U);
  EXPECT_EQ(uses[0].power_w, 40.0);
  EXPECT_NEAR(uses[1].flux_lm, stage.scene.luminaires[2].flux_lm(), 1e-9);
}

TEST(Installed, TheirPowerIsByTheFloorOfTheirRoom) {
  const test::Stage stage(lamp_room());
  const auto rooms = room_powers(stage.scene);
  ASSERT_EQ(rooms.size(), 1U);
  EXPECT_EQ(rooms[0].luminaires, 3U);
  EXPECT_NEAR(rooms[0].per_area_w_m2, 60.0 / 20.0, 0.02);
}

TEST(Installed, LightOfAMaterialIsTheMeanByArea) {
  SurfaceResult surfaces;
  surfaces.points = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 3, 0}};
  surfaces.cells = {{0, 1, 2}, {0, 1, 3}};
  surfaces.material = {0, 0};
  surfaces.illuminance_lux = {100, 200};
  surfaces.luminance_cd_m2 = {10, 20};
  surfaces.material_names = {"wall", "unused"};
  const auto lights = material_lights(surfaces);
  ASSERT_EQ(lights.size(), 1U);
  EXPECT_EQ(lights[0].name, "wall");
  EXPECT_DOUBLE_EQ(lights[0].area_m2, 4.0);
  EXPECT_DOUBLE_EQ(lights[0].illuminance_lux, 175.0);
  EXPECT_DOUBLE_EQ(lights[0].luminance_cd_m2, 17.5);
}

}  // namespace
}  // namespace clerestory::lighting
