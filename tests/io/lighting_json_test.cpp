// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/lighting_json.h"

#include <gtest/gtest.h>

#include <limits>

#include "io/summary.h"

namespace clerestory::io {
namespace {

TEST(LightingJson, AnObserverWithoutGlareHasNoUgr) {
  lighting::Results results;
  results.rooms.resize(1);
  results.rooms[0].name = "hall";
  results.observers.resize(2);
  results.observers[0].observer.name = "desk";
  results.observers[0].room = 0;
  results.observers[0].ugr = 18.5;
  results.observers[1].ugr = -std::numeric_limits<double>::infinity();
  const Json json = observers_json(results);
  EXPECT_EQ(json[0]["name"], "desk");
  EXPECT_EQ(json[0]["room"], "hall");
  EXPECT_EQ(json[0]["ugr"], 18.5);
  EXPECT_TRUE(json[1]["ugr"].is_null());
  EXPECT_TRUE(json[1]["room"].is_null());
}

TEST(LightingJson, ATaskSaysWhatWasAskedAndFoundAndHowItWasJudged) {
  using Verdict = lighting::Criterion::Verdict;
  lighting::Results results;
  lighting::TaskResult& task = results.tasks.emplace_back();
  task.name = "writing";
  task.criteria.push_back(
      {.what = "mean", .unit = "lx", .required = 500, .found = 480, .error = 2, .verdict = Verdict::kFail});
  task.criteria.push_back({.what = "UGR", .unit = "", .required = 19, .at_most = true, .found = 19, .error = 1});
  task.verdict = Verdict::kFail;
  const Json json = tasks_json(results)[0];
  EXPECT_EQ(json["verdict"], "fail");
  EXPECT_EQ(json["criteria"][0]["at_least"], 500.0);
  EXPECT_EQ(json["criteria"][0]["verdict"], "fail");
  EXPECT_EQ(json["criteria"][1]["at_most"], 19.0);
  EXPECT_EQ(json["criteria"][1]["verdict"], "not decided");
  EXPECT_STREQ(word_of(Verdict::kPass), "pass");
}

TEST(LightingJson, LuminairesAddUp) {
  lighting::Results results;
  results.luminaires = {{"a.ies", "row", 2, 5000.0, 60.0}, {"b.ies", "row", 1, 1000.0, 10.0}};
  results.room_power = {{"hall", 0, 3, 70.0, 3.5}};
  const Json json = luminaires_json(results);
  EXPECT_EQ(json["count"], 3);
  EXPECT_EQ(json["power_w"], 70.0);
  EXPECT_EQ(json["kinds"][1]["flux_lm"], 1000.0);
  EXPECT_EQ(json["rooms"][0]["power_w_m2"], 3.5);
}

TEST(LightingJson, MaterialsHaveTheirMeanLuminance) {
  lighting::Results results;
  results.material_light = {{"wall", 20.0, 150.0, 24.0}};
  EXPECT_EQ(material_lights_json(results)[0]["mean_luminance_cd_m2"], 24.0);
}

}  // namespace
}  // namespace clerestory::io
