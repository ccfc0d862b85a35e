// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/stored_solution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>

#include "lighting/run.h"
#include "mesh/error.h"
#include "tests/lighting/stages.h"

namespace clerestory::lighting {
namespace {

using testing::HasSubstr;

/// A study whose solution is kept, with a sensor below the table too.
Study kept_study() {
  Study study = test::furnished_room_study();
  study.grids[0].points.push_back({1.5, 1.8, 0.3});
  study.grids[0].normals.push_back({0, 0, 1});
  study.accuracy.target = 0.05;
  study.keep_solution = true;
  return study;
}

Results answer(const Study& study) {
  NoProgress nobody;
  return run(study, nobody);
}

Results again(const Study& study, const StoredSolution& stored) {
  NoProgress nobody;
  return sense(study, stored, nobody);
}

TEST(StoredSolution, AnswersTheSameGridsToTheBit) {
  const Study study = kept_study();
  const Results solved = answer(study);
  ASSERT_TRUE(solved.solution);
  const Results sensed = again(study, *solved.solution);
  EXPECT_EQ(sensed.grids.at(0).illuminance_lux, solved.grids.at(0).illuminance_lux);
  EXPECT_EQ(sensed.grids.at(0).error_lux, solved.grids.at(0).error_lux);
  EXPECT_EQ(sensed.counts.elements, solved.counts.elements);
  EXPECT_EQ(sensed.counts.links, solved.counts.links);
  EXPECT_EQ(sensed.energy.absorbed_lm, solved.energy.absorbed_lm);
}

TEST(StoredSolution, AnswersOtherGridsAsAFreshRunWithinTheErrors) {
  Study study = kept_study();
  const Results solved = answer(study);
  GridRequest& grid = study.grids.at(0);
  grid.name = "faces";
  grid.points = {{0.5, 3.0, 1.2}, {2.0, 0.4, 1.6}, {3.5, 2.0, 1.2}};
  grid.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  const Results sensed = again(study, *solved.solution);
  const Results fresh = answer(study);
  for (std::size_t i = 0; i < 3; ++i) {
    const double error = std::hypot(sensed.grids[0].error_lux[i], fresh.grids[0].error_lux[i]);
    EXPECT_NEAR(sensed.grids[0].illuminance_lux[i], fresh.grids[0].illuminance_lux[i], 3.0 * error);
    EXPECT_GT(sensed.grids[0].illuminance_lux[i], 0.0F);
  }
}

TEST(StoredSolution, IsKeptOnlyWhereAskedFor) {
  Study study = kept_study();
  study.keep_solution = false;
  EXPECT_FALSE(answer(study).solution);
}

/// What sense() says of a stored solution and a study that do not fit.
std::string refusal(const Study& study, const StoredSolution& stored) {
  try {
    again(study, stored);
  } catch (const InputError& error) {
    return error.problem();
  }
  return "no error";
}

TEST(StoredSolution, OfAnotherStudyIsRefusedWithWhatHasChanged) {
  const Study study = kept_study();
  const Results solved = answer(study);
  Study moved = study;
  for (mesh::Point& p : moved.model.vertices) p.x += p.x > 1.9 ? 0.01 : 0.0;
  EXPECT_THAT(refusal(moved, *solved.solution), HasSubstr("the model has changed"));
  Study clearer = study;
  test::glaze(test::material(clearer, "ceiling"), 0.8);
  EXPECT_THAT(refusal(clearer, *solved.solution), HasSubstr("glazing, openings or bands have changed"));
  Study night = study;
  night.sky.type = Sky::Type::kNone;
  EXPECT_THAT(refusal(night, *solved.solution), HasSubstr("openings"));  // what leads to no light is none
  Study table = study;
  test::shine(test::material(table, "wall"), 9.0);
  EXPECT_THAT(refusal(table, *solved.solution), HasSubstr("other surfaces or lamps shine"));
}

TEST(StoredSolution, WhoseLinksAreDamagedIsRefusedBeforeItIsSolvedAnew) {
  Study study = kept_study();
  const StoredSolution whole = *answer(study).solution;
  study.sky.horizontal_illuminance_lux *= 2.0;
  const auto damaged = [&](auto damage) {
    StoredSolution stored = whole;
    damage(stored);
    return refusal(study, stored);
  };
  for (const std::string& said : {damaged([](StoredSolution& s) { s.receivers.pop_back(); }),
                                  damaged([](StoredSolution& s) { s.receivers.front()[0] = 0x7FFFFFF0; }),
                                  damaged([](StoredSolution& s) { s.receivers.front()[1] = 0x7FFFFFF0; }),
                                  damaged([](StoredSolution& s) { std::swap(s.receivers[0], s.receivers[1]); }),
                                  damaged([](StoredSolution& s) { s.arrivals.front()[0] = 0x0FFFFFF0; }),
                                  damaged([](StoredSolution& s) { s.arrivals.front()[0] = 0x8FFFFFF0; }),
                                  damaged([](StoredSolution& s) { s.arrivals.front()[1] = 0x7FC00000; })}) {
    EXPECT_THAT(said, HasSubstr("damaged"));
  }
}

TEST(StoredSolution, ThatIsDamagedIsRefused) {
  const Study study = kept_study();
  const StoredSolution whole = *answer(study).solution;
  const auto damaged = [&](auto damage) {
    StoredSolution stored = whole;
    damage(stored);
    return refusal(study, stored);
  };
  for (const std::string& said :
       {damaged([](StoredSolution& s) { s.divided.front() = 0xFFFFFFF0; }),
        damaged([](StoredSolution& s) { s.divided.pop_back(); }),
        damaged([](StoredSolution& s) { s.divided.push_back(s.divided.front()); }),
        damaged([](StoredSolution& s) { s.open.push_back(s.elements.back()); }),
        damaged([](StoredSolution& s) { s.elements.pop_back(); }),
        damaged([](StoredSolution& s) { s.irradiance.pop_back(); }),
        damaged([](StoredSolution& s) { s.arrival_errors.pop_back(); }),
        damaged([](StoredSolution& s) { s.closing.pop_back(); }),
        damaged([](StoredSolution& s) { s.given_errors.pop_back(); }),
        damaged([](StoredSolution& s) { s.errors[3][2] = std::numeric_limits<float>::infinity(); }),
        damaged([](StoredSolution& s) { s.irradiance[5][1] = std::numeric_limits<float>::quiet_NaN(); })}) {
    EXPECT_THAT(said, HasSubstr("damaged"));
  }
}

}  // namespace
}  // namespace clerestory::lighting
