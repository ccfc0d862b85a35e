// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/resolve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lighting/run.h"
#include "mesh/error.h"
#include "tests/lighting/stages.h"

namespace clerestory::lighting {
namespace {

using testing::HasSubstr;

/// A study whose solution is kept.
Study kept_study() {
  Study study = test::furnished_room_study();
  study.accuracy.target = 0.05;
  study.keep_solution = true;
  return study;
}

Results fresh(const Study& study) {
  NoProgress nobody;
  return run(study, nobody);
}

Results again(const Study& study, const StoredSolution& stored) {
  NoProgress nobody;
  return sense(study, stored, nobody);
}

std::uint64_t rays_of(const Results& results, const std::string& phase) {
  for (const PhaseTime& time : results.phases) {
    if (time.name == phase) return time.rays;
  }
  throw std::out_of_range(phase);
}

/// Answers a changed study from the solution of the first one: as a fresh run does, within the accuracy.
void expect_as_fresh(const Study& changed) {
  const Results solved = fresh(kept_study());
  const Results resolved = again(changed, *solved.solution);
  const Results expected = fresh(changed);
  EXPECT_EQ(rays_of(resolved, "solving"), 0U);
  for (std::size_t i = 0; i < expected.grids[0].sensors.count(); ++i) {
    const double error = std::hypot(resolved.grids[0].error_lux[i], expected.grids[0].error_lux[i]);
    EXPECT_NEAR(resolved.grids[0].illuminance_lux[i], expected.grids[0].illuminance_lux[i], 2.5 * error) << i;
    EXPECT_GT(std::abs(resolved.grids[0].illuminance_lux[i] / solved.grids[0].illuminance_lux[i] - 1.0F), 0.03F) << i;
  }
}

TEST(Resolve, OtherReflectancesAreSolvedOnTheStoredLinks) {
  Study study = kept_study();
  for (const char* name : {"floor", "wall"}) {
    Material& material = test::material(study, name);
    material.front.reflectance = material.back.reflectance = Spectrum{0.75F};
  }
  expect_as_fresh(study);
}

TEST(Resolve, OtherSkiesAreSolvedOnTheStoredLinks) {
  Study study = kept_study();
  study.sky.type = Sky::Type::kUniform;
  study.sky.horizontal_illuminance_lux = 15'000.0;
  expect_as_fresh(study);
}

TEST(Resolve, DimmedLampsAreSolvedOnTheStoredLinks) {
  Study study = kept_study();
  study.dimming = {{"lamp", 0.2}};
  study.sky.horizontal_illuminance_lux = 500.0;
  expect_as_fresh(study);
}

TEST(Resolve, TwiceTheLightIsTwiceTheIlluminance) {
  Study study = kept_study();
  const Results solved = fresh(study);
  study.sky.horizontal_illuminance_lux *= 2.0;
  study.dimming = {{"lamp", 2.0}};
  const Results twice = again(study, *solved.solution);
  for (std::size_t i = 0; i < twice.grids[0].sensors.count(); ++i) {
    EXPECT_NEAR(twice.grids[0].illuminance_lux[i] / solved.grids[0].illuminance_lux[i], 2.0, 2e-3);
    EXPECT_NEAR(twice.grids[0].error_lux[i] / solved.grids[0].error_lux[i], 2.0, 0.1);
  }
}

TEST(Resolve, ColumnsComeFromTheStoredLinksToo) {
  Study study = kept_study();
  const Results solved = fresh(study);
  study.columns = Columns::kGroups;
  const GridResult grid = again(study, *solved.solution).grids.at(0);
  ASSERT_EQ(grid.groups.size(), 2U);
  for (std::size_t i = 0; i < grid.sensors.count(); ++i) {
    EXPECT_NEAR(grid.illuminance_lux[i] / solved.grids[0].illuminance_lux[i], 1.0, 2e-3);
    EXPECT_NEAR((grid.groups[0].illuminance_lux[i] + grid.groups[1].illuminance_lux[i]) / grid.illuminance_lux[i], 1.0,
                1e-3);
  }
}

/// The room under a sun that falls in through the roof and leaves its patch on walls and floor.
Study sunlit_study(const mesh::Vector& towards) {
  Study study = kept_study();
  study.sky.sun = {.towards = towards, .normal_illuminance_lux = 30'000.0};
  return study;
}

TEST(Resolve, AnotherSunIsCastOnTheStoredLinks) {
  const Results solved = fresh(sunlit_study({0.0, 0.6, 0.8}));
  const Study later = sunlit_study({0.8, 0.0, 0.6});
  const Results resolved = again(later, *solved.solution);
  const Results expected = fresh(later);
  EXPECT_GT(rays_of(resolved, "solving"), 0U);
  EXPECT_LT(rays_of(resolved, "solving"), rays_of(expected, "direct light") + rays_of(expected, "linking"));
  for (std::size_t i = 0; i < expected.grids[0].sensors.count(); ++i) {
    const double error = std::hypot(resolved.grids[0].error_lux[i], expected.grids[0].error_lux[i]);
    EXPECT_NEAR(resolved.grids[0].illuminance_lux[i], expected.grids[0].illuminance_lux[i], 2.5 * error) << i;
  }
}

TEST(Resolve, WithoutTheSunNoRayIsCast) {
  const Results solved = fresh(sunlit_study({0.0, 0.6, 0.8}));
  Study cloudy = sunlit_study({0.0, 0.6, 0.8});
  cloudy.sky.sun.normal_illuminance_lux = 0.0;
  const Results resolved = again(cloudy, *solved.solution);
  const Results expected = fresh(cloudy);
  EXPECT_EQ(rays_of(resolved, "solving"), 0U);
  for (std::size_t i = 0; i < expected.grids[0].sensors.count(); ++i) {
    const double error = std::hypot(resolved.grids[0].error_lux[i], expected.grids[0].error_lux[i]);
    EXPECT_NEAR(resolved.grids[0].illuminance_lux[i], expected.grids[0].illuminance_lux[i], 2.5 * error) << i;
  }
}

TEST(Resolve, WhatWasNotToldApartIsRefused) {
  Study study = kept_study();
  const Results solved = fresh(study);
  study.columns = Columns::kSky577;
  try {
    again(study, *solved.solution);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.problem(), HasSubstr("tells other sources apart"));
  }
}

}  // namespace
}  // namespace clerestory::lighting
