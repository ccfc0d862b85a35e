// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sensor_probe.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using test::Solved;

constexpr std::uint64_t kSeed = 7;

/// A room with a ceiling that shines, and two sensors.
Study lit_room(double accuracy) {
  Study study = test::study_of(support::box_room(4, 5, 3), 0.5, {1, 1, 0.8});
  test::shine(test::material(study, "ceiling"), 1000.0);
  study.grids[0].points.push_back({3, 2, 0.8});
  study.grids[0].normals.push_back({0, 0, 1});
  study.accuracy.target = accuracy;
  return study;
}

double probed(const Solved& solved, const std::vector<std::uint32_t>& grids) {
  const SensorProbe probe(solved.scene, solved.positions, solved.normals, grids, kSeed);
  return probe.discretisation(solved.solution, solved.transport.errors);
}

TEST(SensorProbe, TellsLessOfAFinerSolution) {
  const double coarse = probed(Solved(lit_room(0.08)), {0, 0});
  const double fine = probed(Solved(lit_room(0.01)), {0, 0});
  EXPECT_GT(fine, 0.0);
  EXPECT_LT(fine, coarse);
  EXPECT_LT(coarse, 0.08);
}

TEST(SensorProbe, TellsOfTheWorstGrid) {
  const Solved solved(lit_room(0.08));
  const SensorProbe first(solved.scene, std::span(solved.positions).first(1), std::span(solved.normals).first(1),
                          std::vector<std::uint32_t>{0}, kSeed);
  EXPECT_GE(probed(solved, {0, 1}), first.discretisation(solved.solution, solved.transport.errors));
  EXPECT_GE(probed(solved, {0, 1}), probed(solved, {0, 0}));
}

TEST(SensorProbe, TellsNothingWithoutSensors) {
  const Solved solved(lit_room(0.08));
  const SensorProbe probe(solved.scene, {}, {}, {}, kSeed);
  EXPECT_EQ(probe.discretisation(solved.solution, solved.transport.errors), 0.0);
}

/// Links of the room where the errors at the sensors are told to be such a share of their light.
std::size_t links(double told) {
  const Study study = lit_room(0.02);
  test::Stage stage(study);
  const Importance importance(stage.solution, stage.walks(kSeed));
  NoProgress nobody;
  DirectLight direct = light_directly(stage.solution, importance, 0.002 * study.accuracy.target, kSeed, nobody);
  const Transport transport = solve(stage.solution, importance, std::move(direct),
                                    {.accuracy = study.accuracy.target,
                                     .seed = kSeed,
                                     .error_at_sensors = [told](const SolutionErrors&) { return told; }},
                                    nobody);
  return transport.arrivals.count();
}

TEST(SensorProbe, RefinementEndsWhereTheSensorsAreRightEnough) {
  EXPECT_LT(2 * links(0.005), links(0.02));
  EXPECT_EQ(links(0.01), links(0.005));
  EXPECT_EQ(links(0.012), links(0.02));
}

}  // namespace
}  // namespace clerestory::lighting
