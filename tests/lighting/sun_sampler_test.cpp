// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sun_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lighting/run.h"
#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

constexpr double kNormalLux = 80'000.0;
const Vector kTowards = normalized(Vector{0.2, -1.0, 1.0});

/// A room of 4 m × 4 m × 3 m; in its south wall a hole from x = 1.5 to 2.5 and from z = 1 to 2, in its floor one that a lamp fills.
mesh::Model room_with_hole(const std::vector<Point>& lamp = {}) {
  mesh::Model model;
  const support::Names walls{.material = "wall", .part = "room"};
  const support::Names floor{.material = "floor", .part = "floor"};
  std::vector<std::vector<Point>> holes;
  if (!lamp.empty()) holes.push_back({lamp.rbegin(), lamp.rend()});
  support::add_polygon(model, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, floor, holes);
  if (!lamp.empty()) support::add_polygon(model, lamp, {.material = "lamp", .part = "lamp"});
  support::add_quad(model, {0, 4, 3}, {4, 4, 3}, {4, 0, 3}, {0, 0, 3}, {.material = "ceiling", .part = "ceiling"});
  support::add_quad(model, {4, 4, 0}, {0, 4, 0}, {0, 4, 3}, {4, 4, 3}, walls);
  support::add_quad(model, {0, 4, 0}, {0, 0, 0}, {0, 0, 3}, {0, 4, 3}, walls);
  support::add_quad(model, {4, 0, 0}, {4, 4, 0}, {4, 4, 3}, {4, 0, 3}, walls);
  support::add_polygon(model, {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}}, walls,
                       {{{1.5, 0, 1}, {1.5, 0, 2}, {2.5, 0, 2}, {2.5, 0, 1}}});
  return model;
}

/// The sun's patch on the floor: the hole, sheared along the light.
std::vector<Point> patch() {
  std::vector<Point> corners;
  for (const Point p : {Point{1.5, 0, 1}, Point{2.5, 0, 1}, Point{2.5, 0, 2}, Point{1.5, 0, 2}})
    corners.push_back(p - (p.z / kTowards.z) * kTowards);
  return corners;
}

Study sunlit_room(double reflectance) {
  Study study = test::study_of(room_with_hole(), reflectance, {2, 2, 1});
  study.sky.ground_reflectance = 0.0;
  study.sky.sun = {.towards = kTowards, .normal_illuminance_lux = kNormalLux};
  return study;
}

TEST(SunSampler, TellsWhatIsLitWhollyPartlyAndNot) {
  const test::Stage stage(sunlit_room(0.5));
  const SunSampler sampler(stage.solution, stage.scene.sky.sun, 1);
  const SunSurvey floor = sampler.survey(stage.root("floor"), SunView::kUnknown);
  EXPECT_EQ(floor.view, SunView::kPartly);
  EXPECT_GT(floor.fit.residual, 0.1 * kNormalLux);
  EXPECT_EQ(sampler.survey(stage.root("ceiling"), SunView::kUnknown).view, SunView::kNone);
  EXPECT_EQ(sampler.survey(stage.root("floor"), SunView::kNone).view, SunView::kNone);
  const SunSurvey roof = sampler.survey(stage.root("ceiling", mesh::Side::kBack), SunView::kUnknown);
  EXPECT_EQ(roof.view, SunView::kWhole);
  EXPECT_NEAR(roof.mean_lux, kNormalLux * kTowards.z, 1.0);
}

TEST(SunSampler, MeansKeepTheFluxThroughTheHole) {
  const test::Stage stage(sunlit_room(0.5));
  const SunSampler sampler(stage.solution, stage.scene.sky.sun, 1);
  double flux = 0.0;
  double variance = 0.0;
  for (const mesh::ElementId root : stage.roots("floor")) {
    const ReplicateMean mean = sampler.mean(root, sampler.survey(root, SunView::kUnknown).view, 1.0);
    const double area = stage.solution.tree().area(root);
    flux += mean.mean * area;
    variance += mean.variance * area * area;
  }
  EXPECT_NEAR(flux, kNormalLux * -kTowards.y, 3.0 * std::sqrt(variance));
  EXPECT_LT(std::sqrt(variance), 0.03 * flux);
  EXPECT_GT(variance, 0.0);
}

/// Nine sensors a metre above the floor, none in the sun, that look up, and as many that look down.
void add_sensors(Study& study) {
  GridRequest& grid = study.grids.at(0);
  grid.points.clear();
  grid.normals.clear();
  for (const double z : {1.0, -1.0}) {
    for (const double x : {0.5, 1.3, 3.2}) {
      for (const double y : {0.6, 2.1, 3.5}) {
        grid.points.push_back({x, y, 1.2});
        grid.normals.push_back({0, 0, z});
      }
    }
  }
}

TEST(SunSampler, APatchOfSunLightsARoomLikeALampOfItsShape) {
  constexpr double kReflectance = 0.5;
  Study sun = sunlit_room(kReflectance);
  add_sensors(sun);
  Study lamp = test::study_of(room_with_hole(patch()), kReflectance, {2, 2, 1});
  test::shine(test::material(lamp, "lamp"), kReflectance * kNormalLux * kTowards.z);
  add_sensors(lamp);
  for (Study* study : {&sun, &lamp}) study->mesh.discontinuities = false;
  NoProgress nobody;
  const Results by_sun = run(sun, nobody);
  const Results by_lamp = run(lamp, nobody);
  EXPECT_TRUE(by_sun.accuracy_met);
  EXPECT_LT(std::abs(by_sun.energy.residual), 0.005);
  double mean = 0.0;
  double mean_of_lamp = 0.0;
  std::size_t far = 0;
  const auto& a = by_sun.grids.at(0);
  const auto& b = by_lamp.grids.at(0);
  for (std::size_t i = 0; i < a.illuminance_lux.size(); ++i) {
    mean += a.illuminance_lux[i];
    mean_of_lamp += b.illuminance_lux[i];
    const double error = std::hypot(a.error_lux[i], b.error_lux[i]);
    if (std::abs(a.illuminance_lux[i] - b.illuminance_lux[i]) > 2.0 * error) ++far;
  }
  EXPECT_NEAR(mean, mean_of_lamp, 0.01 * mean_of_lamp);
  EXPECT_LE(far, 1U);
}

TEST(SunSampler, SensorsInThePatchHaveAllOfTheSunAndOthersNone) {
  Study study = sunlit_room(0.0);
  study.mesh.discontinuities = false;
  const std::vector<Point> corners = patch();
  const Point middle = corners[0] + 0.5 * (corners[2] - corners[0]);
  study.grids[0].points = {middle, corners[0] + Vector{0.001, 0.001, 0}, corners[0] + Vector{-0.001, 0.001, 0}};
  study.grids[0].normals.assign(3, {0, 0, 1});
  NoProgress nobody;
  const GridResult grid = run(study, nobody).grids.at(0);
  EXPECT_NEAR(grid.illuminance_lux[0], kNormalLux * kTowards.z, 1.0);
  EXPECT_NEAR(grid.illuminance_lux[1], kNormalLux * kTowards.z, 1.0);
  EXPECT_EQ(grid.illuminance_lux[2], 0.0F);
}

}  // namespace
}  // namespace clerestory::lighting
