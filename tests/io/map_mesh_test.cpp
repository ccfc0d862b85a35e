// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "tests/io/sample_results.h"

namespace clerestory::io {
namespace {

MapMesh mesh_of(const lighting::GridResult& grid) {
  return interpolate(lay_flat(grid.sensors, 0.0), grid.daylight_factor_percent);
}

bool closed(const std::vector<MapPoint>& line) {
  return std::hypot(line.front().x - line.back().x, line.front().y - line.back().y) < 1e-9;
}

double length(const std::vector<MapPoint>& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
  }
  return sum;
}

// The map shifts its plane so that the upper left corner of the outline is the origin.
constexpr double kHeight = 8.0;  // of the office [m]

TEST(Isolines, OfALinearRampLieWhereItHasTheValue) {
  const auto grid = test::make_grid({}, [](double x, double y) { return 1.0 + 0.5 * x + 0.25 * y; });
  const auto lines = isolines(mesh_of(grid), 3.0);
  ASSERT_EQ(lines.size(), 1U);
  for (const MapPoint& p : lines[0]) EXPECT_NEAR(1.0 + 0.5 * p.x + 0.25 * (p.y + kHeight), 3.0, 1e-5);
  // From the wall y = 0 at x = 4 to the wall y = 8 at x = 0, but where no value may leave the range of the sensors'.
  EXPECT_NEAR(length(lines[0]), std::hypot(4.0, 8.0), 0.05);
}

TEST(Isolines, OfALinearRampReachTheWalls) {
  const auto grid = test::make_grid({}, [](double x, double) { return x; });
  const auto lines = isolines(mesh_of(grid), 2.2);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(length(lines[0]), 8.0, 1e-9);
  for (const MapPoint& p : lines[0]) EXPECT_NEAR(p.x, 2.2, 1e-5);
}

TEST(Isolines, RoundAPeakAreClosedAndNearlyCircles) {
  const auto grid = test::make_grid({.columns = 64, .rows = 64, .spacing_m = 0.1}, [](double x, double y) {
    return 10.0 - (x - 3.2) * (x - 3.2) - (y - 3.2) * (y - 3.2);
  });
  const auto lines = isolines(mesh_of(grid), 6.0);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(closed(lines[0]));
  EXPECT_NEAR(length(lines[0]), 2.0 * std::numbers::pi * 2.0, 0.02);
}

TEST(Isolines, OfTwoPeaksAreTwoAboveTheSaddleAndOneBelow) {
  const auto mesh = mesh_of(test::office_grid());
  EXPECT_EQ(isolines(mesh, 9.5).size(), 2U);
  EXPECT_EQ(isolines(mesh, 2.0).size(), 1U);
  EXPECT_TRUE(isolines(mesh, 100.0).empty());
}

TEST(MapMesh, IsBilinearBetweenSensors) {
  const auto mesh = mesh_of(test::make_grid({.columns = 2, .rows = 2, .spacing_m = 1.0}, [](double x, double y) {
    return (x - 0.5) * (y - 0.5);  // 0, 0, 0 and 1 at the sensors
  }));
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const MapPoint& p = mesh.nodes[i];
    const double u = p.x - 0.5;
    const double v = p.y + 2.0 - 0.5;
    const bool between_sensors = u >= 0 && u <= 1 && v >= 0 && v <= 1;
    if (between_sensors) {
      EXPECT_NEAR(mesh.values[i], u * v, 1e-6);
    }
  }
  EXPECT_EQ(mesh.quads.size(), 16U);
  EXPECT_EQ(mesh.nodes.size(), 4U + 9U + 12U);
}

TEST(MapMesh, DoesNotMixRoomsThatShareAWall) {
  auto grid = test::make_grid({.columns = 4, .rows = 4}, [](double, double) { return 1.0; });
  test::append(
      grid, test::make_grid({.columns = 4, .rows = 4, .corner = {1.0, 0.0, 0.8}}, [](double, double) { return 5.0; }));
  const MapMesh mesh = mesh_of(grid);
  EXPECT_EQ((std::set<float>(mesh.values.begin(), mesh.values.end())), (std::set<float>{1.0F, 5.0F}));
  EXPECT_TRUE(isolines(mesh, 3.0).empty());
}

TEST(MapMesh, KeepsWithinTheValuesOfTheSensors) {
  const auto grid = test::make_grid({.columns = 5, .rows = 5}, [](double x, double y) { return x * x * y * y; });
  const MapMesh mesh = mesh_of(grid);
  const auto [low, high] = std::ranges::minmax(grid.daylight_factor_percent);
  for (const float value : mesh.values) {
    EXPECT_GE(value, low);
    EXPECT_LE(value, high);
  }
}

TEST(MapMesh, OfOneSensorIsOneValue) {
  const auto mesh = mesh_of(test::make_grid({.columns = 1, .rows = 1}, [](double, double) { return 2.5; }));
  EXPECT_EQ(mesh.quads.size(), 4U);
  for (const float value : mesh.values) EXPECT_EQ(value, 2.5F);
}

}  // namespace
}  // namespace clerestory::io
