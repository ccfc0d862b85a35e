// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/summary.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using nlohmann::json;

lighting::Results small_results() {
  lighting::Results results;
  auto& grid = results.grids.emplace_back();
  grid.name = "workplane";
  grid.sensors.positions = {{0, 0, 0.8}, {1, 0, 0.8}};
  grid.sensors.left_out = 3;
  grid.metrics.mean_lux = 215.5;
  grid.metrics.uniformity = 0.4;
  grid.metrics.has_daylight_factor = true;
  grid.metrics.mean_df_percent = 2.155;
  grid.metrics.accuracy_reached = 0.018;
  grid.metrics.accuracy_met = true;
  results.accuracy_target = 0.02;
  results.accuracy_reached = 0.018;
  results.accuracy_met = true;
  results.energy.emitted_lm = 1000.0;
  results.energy.residual = 1e-4;
  results.counts.links = 4321;
  results.materials = {{"glass", "glazing 0.70", "named like glass"}};
  results.clean.defects = {{"T-junctions", 4, 4, {}}};
  results.surfaces.part_names = {"floor", "wall"};
  results.assumptions = {"units are metres", "units are metres", "z is up"};
  results.phases = {{"linking", 0.5, 0.3}, {"gathering", 1.0, 0.6}};
  return results;
}

ResultContext small_context() {
  ResultContext context;
  context.study_name = "office";
  context.version = "0.1.0";
  context.command = "clerestory daylight office.toml";
  context.sky = "CIE overcast sky, 10000 lx horizontal";
  context.effective_study = R"({"accuracy": {"target": 0.02}})";
  return context;
}

json parsed(const lighting::Results& results, const RunFigures& figures = {}) {
  return json::parse(summary_json(results, small_context(), figures));
}

TEST(Summary, TellsWhatRaysCost) {
  lighting::Results results = small_results();
  results.phases = {
      {"direct light", 1.0, 1.0, 3000, 0.25}, {"linking", 1.0, 1.0, 1000, 0.25}, {"gathering", 0.5, 0.5, 10, 0.1}};
  const json rays = parsed(results)["rays"];
  EXPECT_EQ(rays["solve"], (json{{"count", 4000}, {"per_cpu_second", 2000.0}, {"share_of_time", 0.25}}));
  EXPECT_EQ(rays["gathering"]["count"], 10);
  EXPECT_DOUBLE_EQ(rays["gathering"]["share_of_time"], 0.2);
}

TEST(Summary, SaysWhatHasStoppedARun) {
  lighting::Results results = small_results();
  EXPECT_TRUE(parsed(results)["stopped"].is_null());
  EXPECT_EQ(parsed(results)["accuracy"]["converged"], true);
  results.converged = results.accuracy_met = false;
  results.stopped = lighting::Stop{lighting::Stop::By::kMemory, "linking"};
  EXPECT_EQ(parsed(results)["status"], "accuracy-not-reached");
  EXPECT_EQ(parsed(results)["stopped"], json::parse(R"({"by": "memory", "phase": "linking"})"));
  EXPECT_EQ(parsed(results)["accuracy"]["converged"], false);
  results.stopped->by = lighting::Stop::By::kUser;
  EXPECT_EQ(parsed(results)["status"], "partial");
  EXPECT_EQ(parsed(results)["stopped"]["by"], "interruption");
}

TEST(Summary, ElementsThatAreUsedUpAreNoFaultWhereTheAccuracyIsMet) {
  lighting::Results results = small_results();
  results.stopped = lighting::Stop{lighting::Stop::By::kElements, "direct light"};
  EXPECT_EQ(parsed(results)["stopped"], json::parse(R"({"by": "elements", "phase": "direct light"})"));
  EXPECT_EQ(parsed(results)["status"], "done");
  results.accuracy_met = false;
  EXPECT_EQ(parsed(results)["status"], "accuracy-not-reached");
}

TEST(Summary, SaysWhatRanAndHow) {
  const json j = parsed(small_results());
  EXPECT_EQ(j["status"], "done");
  EXPECT_EQ(j["version"], "0.1.0");
  EXPECT_EQ(j["kind"], "daylight");
  EXPECT_EQ(j["command"], "clerestory daylight office.toml");
  EXPECT_EQ(j["study"]["accuracy"]["target"], 0.02);
}

TEST(Summary, HoldsTheMetricsOfEachGrid) {
  const json grid = parsed(small_results())["grids"][0];
  EXPECT_EQ(grid["name"], "workplane");
  EXPECT_EQ(grid["sensors"], 2);
  EXPECT_EQ(grid["sensors_left_out"], 3);
  EXPECT_EQ(grid["mean_lux"], 215.5);
  EXPECT_EQ(grid["mean_daylight_factor_percent"], 2.155);
  EXPECT_EQ(grid["accuracy_met"], true);
}

TEST(Summary, AGridWithoutDaylightFactorHasNoSuchKeys) {
  auto results = small_results();
  results.grids[0].metrics.has_daylight_factor = false;
  EXPECT_FALSE(parsed(results)["grids"][0].contains("mean_daylight_factor_percent"));
}

TEST(Summary, HoldsAccuracyEnergyCountsMaterialsAndDefects) {
  const json j = parsed(small_results());
  EXPECT_EQ(j["accuracy"], (json{{"asked", 0.02}, {"reached", 0.018}, {"met", true}, {"converged", true}}));
  EXPECT_EQ(j["energy_balance"]["emitted_lm"], 1000.0);
  EXPECT_EQ(j["energy_balance"]["residual"], 1e-4);
  EXPECT_EQ(j["counts"]["links"], 4321);
  EXPECT_EQ(j["parts"], (json{"floor", "wall"}));
  EXPECT_EQ(j["materials"][0], (json{{"name", "glass"}, {"became", "glazing 0.70"}, {"why", "named like glass"}}));
  EXPECT_EQ(j["defects"]["T-junctions"], (json{{"found", 4}, {"mended", 4}}));
}

TEST(Summary, SaysEachAssumptionOnce) {
  EXPECT_EQ(parsed(small_results())["assumptions"], (json{"units are metres", "z is up"}));
}

TEST(Summary, HoldsTimeByPhaseAndMemory) {
  RunFigures figures;
  figures.before = {{"reading", 0.1, 0.1}};
  figures.after = {{"writing", 0.2, 0.25}};
  figures.threads = 2;
  const json j = parsed(small_results(), figures);
  EXPECT_EQ(j["cpu_seconds"]["reading"], 0.1);
  EXPECT_EQ(j["cpu_seconds"]["gathering"], 1.0);
  EXPECT_NEAR(j["wall_seconds"]["total"].get<double>(), 0.1 + 0.3 + 0.6 + 0.25, 1e-12);
  EXPECT_GT(j["peak_memory_mb"].get<double>(), 1.0);
  EXPECT_EQ(j["threads"], 2);
}

TEST(Summary, AnAccuracyThatWasNotReachedIsMarked) {
  auto results = small_results();
  results.accuracy_met = false;
  EXPECT_EQ(parsed(results)["status"], "accuracy-not-reached");
}

TEST(Summary, NeverHoldsANumberThatIsNotFinite) {
  auto results = small_results();
  results.grids[0].metrics.uniformity = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(parsed(results), std::logic_error);
  results = small_results();
  results.energy.closure = std::numeric_limits<double>::infinity();
  EXPECT_THROW(parsed(results), std::logic_error);
}

TEST(Summary, NamesThatAreNotUtf8AreStillWritten) {
  auto results = small_results();
  results.surfaces.part_names = {"b\xfcro"};
  EXPECT_EQ(parsed(results)["parts"][0], "b\xef\xbf\xbdro");
}

TEST(Summary, AFailureSaysWhy) {
  const json j = json::parse(failure_json(small_context(), "no space left"));
  EXPECT_EQ(j["status"], "failed");
  EXPECT_EQ(j["why"], "no space left");
  EXPECT_EQ(j["files"], (json{"summary.json"}));
}

TEST(EarlierSummary, GivesStatusAndFiles) {
  const test::ScratchFolder scratch;
  const auto file = scratch.path() / "summary.json";
  RunFigures figures;
  figures.files = {"workplane.csv", "summary.json"};
  test::write_text(file, summary_json(small_results(), small_context(), figures));
  const auto earlier = read_earlier_summary(file);
  ASSERT_TRUE(earlier);
  EXPECT_EQ(earlier->status, "done");
  EXPECT_EQ(earlier->files, figures.files);
}

TEST(EarlierSummary, IsNotWhatSomebodyElseWrote) {
  const test::ScratchFolder scratch;
  const auto file = scratch.path() / "summary.json";
  EXPECT_FALSE(read_earlier_summary(file));
  for (const char* text : {"", "[1, 2", "[]", "{}", R"({"program": 3, "files": ["thesis.doc"]})",
                           R"({"status": "done", "files": ["thesis.doc"]})"}) {
    test::write_text(file, text);
    EXPECT_FALSE(read_earlier_summary(file)) << text;
  }
}

TEST(EarlierSummary, NeverNamesAFileOutsideItsFolder) {
  const test::ScratchFolder scratch;
  const auto file = scratch.path() / "summary.json";
  test::write_text(file, R"({"program": "clerestory", "files": ["../x", "/etc/passwd", "..", ".", "", 7, "a.csv"]})");
  EXPECT_EQ(read_earlier_summary(file)->files, std::vector<std::string>{"a.csv"});
}

}  // namespace
}  // namespace clerestory::io
