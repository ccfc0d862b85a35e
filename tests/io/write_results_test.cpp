// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write_results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mesh/error.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using Names = std::set<std::string>;

lighting::Study study_with_grids(std::initializer_list<const char*> names) {
  lighting::Study study;
  for (const char* name : names) study.grids.emplace_back().name = name;
  return study;
}

/// Two sensors side by side, and one triangle of surface.
lighting::Results small_results() {
  lighting::Results results;
  results.shadow_lines.emplace();
  auto& grid = results.grids.emplace_back();
  grid.name = "desk";
  for (const double x : {0.0, 1.0}) {
    grid.sensors.positions.push_back({x, 0.0, 0.8});
    grid.sensors.normals.push_back({0.0, 0.0, 1.0});
    grid.sensors.cells.push_back(
        {{{x - 0.5, -0.5, 0.8}, {x + 0.5, -0.5, 0.8}, {x + 0.5, 0.5, 0.8}, {x - 0.5, 0.5, 0.8}}});
  }
  grid.illuminance_lux = {100.0F, 200.0F};
  grid.error_lux = {1.0F, 2.0F};
  auto& surfaces = results.surfaces;
  surfaces.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  surfaces.point_illuminance_lux = {1.0F, 2.0F, 3.0F};
  surfaces.cells = {{0, 1, 2}};
  surfaces.side = {0};
  for (auto* values : {&surfaces.illuminance_lux, &surfaces.error_lux, &surfaces.radiosity_lm_m2,
                       &surfaces.luminance_cd_m2, &surfaces.reflectance})
    *values = {1.0F};
  for (auto* ids : {&surfaces.level, &surfaces.part, &surfaces.material, &surfaces.room}) *ids = {0};
  surfaces.part_names = surfaces.material_names = surfaces.room_names = {"a"};
  results.accuracy_met = true;
  return results;
}

/// Stops at the n-th call of advance().
class StopAt final : public Progress {
 public:
  explicit StopAt(int calls) : left_(calls) {}
  void phase(std::string_view) override {}
  void advance(double) override {
    if (--left_ == 0) throw Interrupted();
  }

 private:
  int left_;
};

TEST(ResultNames, AreThreeAGridAndFourForAll) {
  EXPECT_THAT(result_names(study_with_grids({"desk"}), "a.toml"),
              testing::UnorderedElementsAre("summary.json", "surfaces.vtp", "discontinuities.vtp", "result.vtm",
                                            "desk.csv", "desk.vtp", "desk.png"));
}

TEST(ResultNames, AreWithoutTheLinesWhereNoneAreAskedFor) {
  lighting::Study study = study_with_grids({"desk"});
  study.mesh.discontinuities = false;
  EXPECT_THAT(result_names(study, "a.toml"), testing::Not(testing::Contains("discontinuities.vtp")));
}

TEST(ResultNames, RefuseGridsThatWouldShareAFileOrHaveNone) {
  EXPECT_THROW(result_names(study_with_grids({"surfaces"}), "a.toml"), InputError);
  EXPECT_THROW(result_names(study_with_grids({"desk", "desk"}), "a.toml"), InputError);
  for (const char* name : {"", "../desk", "a/b", ".hidden", "two\nlines"})
    EXPECT_THROW(result_names(study_with_grids({name}), "a.toml"), InputError) << name;
}

TEST(WriteResults, WritesWhatResultNamesPromisesAndListsIt) {
  const test::ScratchFolder scratch;
  NoProgress progress;
  const std::string summary = write_results(scratch.path(), small_results(), {}, {}, progress);
  const auto promised = result_names(study_with_grids({"desk"}), "a.toml");
  EXPECT_EQ(test::names_below(scratch.path()), Names(promised.begin(), promised.end()));
  EXPECT_EQ(test::read_text(scratch.path() / "summary.json"), summary);
  EXPECT_THAT(nlohmann::json::parse(summary)["files"].get<std::vector<std::string>>(),
              testing::UnorderedElementsAreArray(promised));
}

TEST(WriteResults, SeveralMomentsShareATableAndHaveAMapEach) {
  lighting::Results results = small_results();
  results.grids.push_back(results.grids[0]);
  results.grids[0].moment = "2026-03-21T0900";
  results.grids[1].moment = "2026-03-21T1200";
  lighting::SurfaceResult& surfaces = results.surfaces;
  surfaces.moments.push_back({"2026-03-21T0900", surfaces.point_illuminance_lux, {1.0F}, {1.0F}, {1.0F}, {1.0F}});
  for (auto* values : {&surfaces.point_illuminance_lux, &surfaces.illuminance_lux, &surfaces.error_lux,
                       &surfaces.radiosity_lm_m2, &surfaces.luminance_cd_m2})
    values->clear();
  lighting::Study study = study_with_grids({"desk"});
  for (const lighting::GridResult& grid : results.grids) study.moments.emplace_back().moment = grid.moment;
  const test::ScratchFolder scratch;
  NoProgress nobody;
  const auto json = nlohmann::json::parse(write_results(scratch.path() / "out", results, {}, {}, nobody));
  const std::vector<std::string> promised = result_names(study, "a.toml");
  const auto written = json["files"].get<Names>();
  EXPECT_EQ(written, Names(promised.begin(), promised.end()));
  EXPECT_TRUE(written.contains("desk_2026-03-21T0900.png"));
  EXPECT_EQ(json["grids"][1]["name"], "desk");
  EXPECT_EQ(json["grids"][1]["moment"], "2026-03-21T1200");
}

TEST(WriteResults, AnInterruptionAtAnyStepLeavesNothing) {
  const test::ScratchFolder scratch;
  for (int calls = 1; calls <= 3; ++calls) {
    StopAt progress(calls);
    EXPECT_THROW(write_results(scratch.path() / "out", small_results(), {}, {}, progress), Interrupted);
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "out"));
  }
}

TEST(WriteResults, ResultsThatAreNotFiniteAreNeverWritten) {
  const test::ScratchFolder scratch;
  auto results = small_results();
  results.grids[0].metrics.mean_lux = std::numeric_limits<double>::quiet_NaN();
  NoProgress progress;
  EXPECT_THROW(write_results(scratch.path() / "out", results, {}, {}, progress), std::logic_error);
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "out"));
}

TEST(WriteFailure, LeavesTheReasonAndTheOlderResults) {
  const test::ScratchFolder scratch;
  NoProgress progress;
  write_results(scratch.path(), small_results(), {}, {}, progress);
  write_failure(scratch.path(), {}, "out of memory");
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "previous" / "desk.csv"));
  const auto summary = nlohmann::json::parse(test::read_text(scratch.path() / "summary.json"));
  EXPECT_EQ(summary["status"], "failed");
  EXPECT_EQ(summary["why"], "out of memory");
}

}  // namespace
}  // namespace clerestory::io
