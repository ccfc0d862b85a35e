// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/cast_sun.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

constexpr double kNormalLux = 10'000.0;
const mesh::Vector kTowards{0.0, -0.6, 0.8};

/// A room whose ceiling is an air polygon where the sun is to fall in from above.
Study room(bool open_above) {
  mesh::Model model = support::box_room(4, 4, 3);
  Study study = test::study_of(std::move(model), 0.5, {2, 2, 1});
  if (open_above) test::leave_open(test::material(study, "ceiling"));
  study.sky = {};  // a sun is seen where light comes from outdoors
  return study;
}

Sun sun() { return {.towards = kTowards, .normal_illuminance_lux = kNormalLux}; }

double flux_lm(const Solution& solution, const CastSun& cast) {
  double flux = 0.0;
  for (const GroupDirect& given : cast.direct) flux += given.lux.value * solution.tree().area(given.node);
  return flux;
}

TEST(CastSun, AllThatFallsThroughAnOpeningArrivesInside) {
  const test::Stage stage(room(true));
  const CastSun cast = cast_sun(stage.solution, sun(), 3, 0.01, 1);
  double variance = 0.0;
  for (const GroupError& e : cast.errors) {
    const double area = stage.solution.tree().area(e.node);
    variance += e.errors.noise2 * area * area;
    EXPECT_EQ(e.group, 3U);
  }
  EXPECT_GT(variance, 0.0);
  // Inside of the room, and as much on the outsides of its walls as their size and the sun's height say.
  const double through_roof = 16.0 * kNormalLux * kTowards.z;
  const double on_south_wall = 12.0 * kNormalLux * -kTowards.y;
  EXPECT_NEAR(flux_lm(stage.solution, cast), through_roof + on_south_wall, 3.0 * std::sqrt(variance));
}

TEST(CastSun, AClosedRoomTakesItAllOnItsOutsidesExactly) {
  const test::Stage stage(room(false));
  const CastSun cast = cast_sun(stage.solution, sun(), 0, 0.01, 1);
  EXPECT_NEAR(flux_lm(stage.solution, cast), kNormalLux * (16.0 * kTowards.z + 12.0 * -kTowards.y), 1.0);
  for (const GroupError& e : cast.errors) EXPECT_LT(e.errors.misfit2, 1e-3F);
}

TEST(CastSun, AnElementAtTheEdgeOfAPatchHasTheErrorOfItsLine) {
  const test::Stage stage(room(true));
  const CastSun cast = cast_sun(stage.solution, sun(), 0, 0.01, 1);
  double most = 0.0;
  for (const GroupError& e : cast.errors) most = std::max(most, std::sqrt(double{e.errors.misfit2}));
  EXPECT_GT(most, 0.1 * kNormalLux);
}

TEST(CastSun, FinerElementsTakeTheSameFlux) {
  test::Stage stage(room(true));
  const double coarse = flux_lm(stage.solution, cast_sun(stage.solution, sun(), 0, 0.01, 1));
  for (int round = 0; round < 3; ++round) {
    for (const mesh::ElementId e : stage.solution.elements()) stage.solution.open(e);
  }
  const CastSun fine = cast_sun(stage.solution, sun(), 0, 0.01, 1);
  EXPECT_NEAR(flux_lm(stage.solution, fine) / coarse, 1.0, 0.01);
  double misfit = 0.0;
  for (const GroupError& e : fine.errors) misfit += e.errors.misfit2 > 0.0F ? 1.0 : 0.0;
  EXPECT_LT(misfit, static_cast<double>(fine.errors.size()));
}

TEST(CastSun, UnderTheHorizonItGivesNothing) {
  const test::Stage stage(room(true));
  Sun down = sun();
  down.towards.z = -0.8;
  EXPECT_TRUE(cast_sun(stage.solution, down, 0, 0.01, 1).direct.empty());
}

}  // namespace
}  // namespace clerestory::lighting
