// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map_plan.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/io/sample_results.h"

namespace clerestory::io {
namespace {

double uniform(double, double) { return 1.0; }

TEST(MapPlan, KeepsDistancesAndHasItsNorth) {
  const auto grid = test::office_grid();
  const MapPlan plan = lay_flat(grid.sensors, 30.0);
  ASSERT_EQ(plan.panels.size(), 1U);
  EXPECT_EQ(plan.panels[0].caption, "z = 0.80 m");
  EXPECT_NEAR(plan.box.width(), 6.0, 1e-12);
  EXPECT_NEAR(plan.box.height(), 8.0, 1e-12);
  EXPECT_NEAR(plan.positions[1].x - plan.positions[0].x, 0.25, 1e-12);
  EXPECT_TRUE(plan.seen_from_above);
  EXPECT_NEAR(plan.north.x, -0.5, 1e-12);  // counter-clockwise
  EXPECT_NEAR(plan.north.y, std::sqrt(0.75), 1e-12);
}

TEST(MapPlan, NoSkyLinesLieInThePlaneOfTheirSensors) {
  auto grid = test::office_grid();
  const double z = grid.sensors.positions[0].z;
  const std::vector<std::array<mesh::Point, 2>> lines{
      {{{1, 4, z}, {2, 4, z}}}, {{{1, 5, z}, {4, 5, z}}}, {{{1, 4, z + 0.1}, {5, 4, z + 0.1}}}};
  const MapPlan plan = lay_flat(grid.sensors, 0.0, lines);
  ASSERT_EQ(plan.no_sky.size(), 2U);  // the third is in no plane; the longest first
  EXPECT_NEAR(plan.no_sky[0][1].x - plan.no_sky[0][0].x, 3.0, 1e-12);
  const MapPoint& sensor = plan.positions[0];
  EXPECT_NEAR(plan.no_sky[0][0].y - sensor.y, 5.0 - grid.sensors.positions[0].y, 1e-12);
  EXPECT_NEAR(plan.no_sky[1][0].x - sensor.x, 1.0 - grid.sensors.positions[0].x, 1e-12);
}

TEST(MapPlan, ALongPlanOnEndIsTurnedToTheRight) {
  const MapPlan plan = lay_flat(test::make_grid({.columns = 4, .rows = 40}, uniform).sensors, 0.0);
  EXPECT_NEAR(plan.box.width(), 10.0, 1e-12);
  EXPECT_NEAR(plan.box.height(), 1.0, 1e-12);
  EXPECT_NEAR(plan.north.x, 1.0, 1e-12);
  EXPECT_NEAR(plan.north.y, 0.0, 1e-12);
}

TEST(MapPlan, StoreysLieSideBySideWithoutOverlap) {
  auto grid = test::office_grid();
  test::append(grid, test::make_grid({.corner = {0, 0, 3.8}}, uniform));
  const MapPlan plan = lay_flat(grid.sensors, 0.0);
  ASSERT_EQ(plan.panels.size(), 2U);
  const MapBox& a = plan.panels[0].box;
  const MapBox& b = plan.panels[1].box;
  EXPECT_TRUE(a.high.x < b.low.x || a.low.y > b.high.y);
  EXPECT_EQ(plan.panels[1].caption, "z = 3.80 m");
  EXPECT_NE(plan.zone[0], plan.zone[768]);
}

TEST(MapPlan, AStepInTheFloorStaysOnePlan) {
  auto grid = test::office_grid();
  test::append(grid, test::make_grid({.corner = {6.2, 0, 0.95}}, uniform));
  EXPECT_EQ(lay_flat(grid.sensors, 0.0).panels.size(), 1U);
}

TEST(MapPlan, AWallIsSeenFromTheRoomWithItsTopUp) {
  // The wall y = 0 looks north into the room; who looks at it has east, +x, on his left.
  const auto grid =
      test::make_grid({.columns = 24, .rows = 12, .corner = {6, 0, 0}, .right = {-1, 0, 0}, .up = {0, 0, 1}}, uniform);
  const MapPlan plan = lay_flat(grid.sensors, 0.0);
  ASSERT_EQ(plan.panels.size(), 1U);
  EXPECT_FALSE(plan.seen_from_above);
  EXPECT_EQ(plan.panels[0].caption, "looking N");
  EXPECT_NEAR(plan.positions[1].x - plan.positions[0].x, 0.25, 1e-12);
  EXPECT_NEAR(plan.positions[24].y - plan.positions[0].y, 0.25, 1e-12);
}

TEST(MapPlan, TheFourWallsOfARoomAreFourPanels) {
  lighting::GridResult grid;
  const mesh::Vector up{0, 0, 1};
  test::append(grid, test::make_grid({.corner = {6, 0, 0}, .right = {-1, 0, 0}, .up = up}, uniform));
  test::append(grid, test::make_grid({.corner = {0, 8, 0}, .right = {1, 0, 0}, .up = up}, uniform));
  test::append(grid, test::make_grid({.corner = {0, 0, 0}, .right = {0, 1, 0}, .up = up}, uniform));
  test::append(grid, test::make_grid({.corner = {6, 8, 0}, .right = {0, -1, 0}, .up = up}, uniform));
  const MapPlan plan = lay_flat(grid.sensors, 0.0);
  ASSERT_EQ(plan.panels.size(), 4U);
  for (std::size_t i = 0; i < plan.inside.size(); ++i) ASSERT_EQ(plan.inside[i], 1) << i;  // each in its own outline
}

TEST(MapPlan, AWallTakesNoOutlineThatHasNoSensors) {
  auto grid = test::make_grid({.columns = 24, .rows = 12, .right = {0, 1, 0}, .up = {0, 0, 1}}, uniform);  // looks east
  const auto quad = [](double x, double y) {
    return std::vector<mesh::Point>{{x, y, 1}, {x, y + 0.2, 1}, {x, y + 0.2, 2}, {x, y, 2}};
  };
  grid.sensors.outlines.push_back(quad(0.5, -0.3));                               // a reveal that looks east, near by
  grid.sensors.outlines.push_back(quad(4.0, 1.0));                                // far away
  grid.sensors.outlines.push_back({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}});  // looks north
  EXPECT_EQ(lay_flat(grid.sensors, 0.0).outlines.size(), 1U);
}

TEST(MapPlan, AnOutlineWoundTheOtherWayIsAHole) {
  auto grid = test::office_grid();
  grid.sensors.outlines.push_back({{2, 2, 0.8}, {2, 3, 0.8}, {3, 3, 0.8}, {3, 2, 0.8}});
  const MapPlan plan = lay_flat(grid.sensors, 0.0);
  EXPECT_FALSE(plan.outlines[0].hole);
  EXPECT_TRUE(plan.outlines[1].hole);
}

TEST(MapPlan, ScatteredDirectionsAreSeenFromAbove) {
  lighting::Sensors sensors;
  for (int i = 0; i < 100; ++i) {
    const double a = 0.0628 * i;
    sensors.positions.push_back({5.0 * std::cos(a), 5.0 * std::sin(a), 0.1 * i});
    sensors.normals.push_back({std::cos(a), std::sin(a), 0.0});
  }
  const MapPlan plan = lay_flat(sensors, 0.0);
  EXPECT_EQ(plan.panels.size(), 1U);
  EXPECT_TRUE(plan.seen_from_above);
}

}  // namespace
}  // namespace clerestory::io
