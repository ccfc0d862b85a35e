// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sun_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lighting/glazing.h"
#include "lighting/run.h"
#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

constexpr double kNormalLux = 80'000.0;
const Vector kTowards = normalized(Vector{0.3, -1.0, 0.8});

/// A floor of 10 m × 10 m, and 2 m above it a square of 1 m of some material.
mesh::Model square_over_floor() {
  mesh::Model model;
  support::add_quad(model, {-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, {.material = "floor", .part = "floor"});
  support::add_quad(model, {0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}, {.material = "square", .part = "square"});
  return model;
}

Study sunlit(mesh::Model model, double reflectance = 0.0) {
  Study study = test::study_of(std::move(model), reflectance, {0, 0, 0.1});
  study.sky.ground_reflectance = 0.0;
  study.sky.sun = {.towards = kTowards, .normal_illuminance_lux = kNormalLux};
  return study;
}

/// Where the shadow of a point lies on the floor.
Point shadow_of(const Point& p) { return p - (p.z / kTowards.z) * kTowards; }

double lux_at(const test::Stage& stage, const Point& at, const Vector& normal = {0, 0, 1}) {
  return sun_illuminance(stage.scene, stage.local(at) + 1e-6 * normal, normal);
}

TEST(SunLight, FallsByTheCosine) {
  const test::Stage stage(sunlit(square_over_floor()));
  EXPECT_NEAR(lux_at(stage, {-3, -3, 0}), kNormalLux * kTowards.z, 1e-6);
  EXPECT_EQ(lux_at(stage, {-3, -3, 0.5}, {0, 1, 0}), 0.0);
}

TEST(SunLight, ShadowsAreExactToATenthOfAMillimetre) {
  const test::Stage stage(sunlit(square_over_floor()));
  const Point corner = shadow_of({0, 0, 2});
  for (const double d : {1e-4, 0.1, 0.5}) {
    EXPECT_EQ(lux_at(stage, corner + Vector{d, d, 0}), 0.0) << d;
    EXPECT_GT(lux_at(stage, corner + Vector{-d, d, 0}), 0.0) << d;
    EXPECT_GT(lux_at(stage, corner + Vector{d, -d, 0}), 0.0) << d;
  }
}

TEST(SunLight, PassesGlassByItsAngle) {
  Study study = sunlit(square_over_floor());
  test::glaze(test::material(study, "square"), 0.70);
  const test::Stage stage(study);
  const double passed =
      mesh::transmittance_at(stage.scene.glazings.at(0).transmittance, static_cast<float>(kTowards.z));
  const Point middle = shadow_of({0.5, 0.5, 2});
  EXPECT_NEAR(lux_at(stage, middle), kNormalLux * kTowards.z * passed, 1.0);
}

TEST(SunLight, IsMirroredByPanes) {
  // A pane that stands on the floor and looks at the sun throws light in front of it.
  mesh::Model model;
  support::add_quad(model, {-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, {.material = "floor", .part = "floor"});
  support::add_quad(model, {-2, 0, 0.5}, {2, 0, 0.5}, {2, 0, 1.5}, {-2, 0, 1.5}, {.material = "pane", .part = "pane"});
  Study study = sunlit(std::move(model));
  test::glaze(test::material(study, "pane"), 0.70);
  const test::Stage stage(study);
  ASSERT_EQ(stage.scene.pane_normals.size(), 1U);
  const double mirrored =
      mesh::transmittance_at(stage.scene.glazings.at(0).reflectance, static_cast<float>(-kTowards.y));
  // From the pane at a height of 1 m the light goes down as it came, but away to the south.
  const double away = -1.0 / kTowards.z * -kTowards.y;
  const double aside = -1.0 / kTowards.z * kTowards.x;
  EXPECT_NEAR(lux_at(stage, {aside, away, 0}), kNormalLux * kTowards.z * (1.0 + mirrored), 1.0);
  EXPECT_NEAR(lux_at(stage, {aside, 2.0 * away, 0}), kNormalLux * kTowards.z, 1e-6);
}

TEST(SunLight, UnderTheHorizonGivesNothing) {
  Study study = sunlit(square_over_floor());
  study.sky.sun.towards = normalized(Vector{0.3, -1.0, -0.01});
  const test::Stage stage(study);
  EXPECT_EQ(lux_at(stage, {-3, -3, 0.5}, {0, -1, 0}), 0.0);
  EXPECT_FALSE(stage.scene.has_sky());
}

TEST(SunLight, TheDiscHasItsDiameterAndItsPenumbraItsWidth) {
  const Sun sun{.towards = kTowards, .normal_illuminance_lux = 1.0, .disc = true};
  const double rim = 0.5 * kSunDiameterDeg * std::numbers::pi / 180.0;
  double mean = 0.0;
  double widest = 0.0;
  constexpr int kSteps = 100;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double off = std::acos(std::min(1.0, dot(sun_direction(sun, (i + 0.5) / kSteps, j / 100.0), kTowards)));
      mean += off * off / (kSteps * kSteps);
      widest = std::max(widest, off);
    }
  }
  EXPECT_LT(widest, rim);
  EXPECT_NEAR(mean, 0.5 * rim * rim, 1e-3 * rim * rim);

  // Half of the disc stands behind an edge where the shadow of a point would end; all and none of it a penumbra's half further on.
  Study study = sunlit(square_over_floor());
  study.sky.sun = {.towards = {0, 0, 1}, .normal_illuminance_lux = kNormalLux, .disc = true};
  const test::Stage stage(study);
  const double half_width = 2.0 * std::tan(rim);
  EXPECT_NEAR(lux_at(stage, {0.0, 0.5, 0}), 0.5 * kNormalLux, 0.03 * kNormalLux);
  EXPECT_NEAR(lux_at(stage, {-1.01 * half_width, 0.5, 0}), kNormalLux, 2.0);
  EXPECT_EQ(lux_at(stage, {1.01 * half_width, 0.5, 0}), 0.0);
}

TEST(SunLight, SensorsInAPenumbraTellTheirError) {
  Study study = sunlit(square_over_floor());
  study.sky.sun = {.towards = {0, 0, 1}, .normal_illuminance_lux = kNormalLux, .disc = true};
  study.grids[0].points = {{0.0, 0.5, 0}, {0.5, 0.5, 0}, {-1.0, 0.5, 0}};
  study.grids[0].normals.assign(3, {0, 0, 1});
  study.mesh.discontinuities = false;
  NoProgress nobody;
  const Results results = run(study, nobody);
  const GridResult& grid = results.grids.at(0);
  EXPECT_GT(grid.error_lux[0], 0.0F);
  EXPECT_NEAR(grid.illuminance_lux[0], 0.5 * kNormalLux, 3.0 * grid.error_lux[0] + 1.0);
  EXPECT_EQ(grid.illuminance_lux[1], 0.0F);
  EXPECT_NEAR(grid.illuminance_lux[2], kNormalLux, 2.0);
}

}  // namespace
}  // namespace clerestory::lighting
