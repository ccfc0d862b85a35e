// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/en12464.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace clerestory::lighting {
namespace {

using testing::Contains;
using testing::HasSubstr;
using Verdict = Criterion::Verdict;

GridResult grid(std::vector<float> lux, float error_lux) {
  GridResult result;
  result.error_lux.assign(lux.size(), error_lux);
  result.illuminance_lux = std::move(lux);
  return result;
}

const Criterion& criterion(const TaskResult& result, const std::string& what) {
  for (const Criterion& c : result.criteria)
    if (c.what.find(what) != std::string::npos) return c;
  throw std::out_of_range(what);
}

TEST(En12464, AFigureNearerToTheLimitThanTwiceItsErrorIsNotDecided) {
  Criterion c{.what = "", .unit = "", .required = 500.0, .found = 520.0, .error = 9.0};
  EXPECT_EQ(verdict_of(c), Verdict::kPass);
  c.error = 11.0;
  EXPECT_EQ(verdict_of(c), Verdict::kUndecided);
  c.found = 470.0;
  EXPECT_EQ(verdict_of(c), Verdict::kFail);
  c.at_most = true;
  EXPECT_EQ(verdict_of(c), Verdict::kPass);
  EXPECT_EQ(verdict_of({.what = "", .unit = "", .required = 500.0, .found = 500.0, .error = 0.0}), Verdict::kPass);
}

TEST(En12464, MeanAndUniformityOfTheTaskAreaAreJudged) {
  const GridResult task = grid({400, 500, 600, 700}, 2);
  TaskFindings findings;
  findings.areas[0] = &task;
  const TaskResult result = judge({.task = "writing", .illuminance_lux = 500, .uniformity = 0.8}, findings);
  EXPECT_EQ(result.task, "writing");
  EXPECT_DOUBLE_EQ(criterion(result, "mean, task area").found, 550.0);
  EXPECT_NEAR(criterion(result, "mean, task area").error, 2.0, 1e-9);
  EXPECT_EQ(criterion(result, "mean, task area").verdict, Verdict::kPass);
  EXPECT_NEAR(criterion(result, "uniformity, task area").found, 400.0 / 550.0, 1e-9);
  EXPECT_EQ(criterion(result, "uniformity, task area").verdict, Verdict::kFail);
  EXPECT_EQ(result.verdict, Verdict::kFail);
}

TEST(En12464, SurroundingAndBackgroundFollowFromTheTask) {
  struct Case {
    double task, surrounding;
  };
  for (const Case& k : {Case{750, 500}, Case{500, 300}, Case{300, 200}, Case{200, 150}, Case{100, 100}}) {
    const GridResult bright = grid({1000, 1000}, 0);
    TaskFindings findings;
    findings.areas[0] = findings.areas[1] = findings.areas[2] = &bright;
    const TaskResult result = judge({.task = "", .illuminance_lux = k.task, .uniformity = 0.6}, findings);
    EXPECT_EQ(criterion(result, "mean, immediate surrounding").required, k.surrounding);
    EXPECT_EQ(criterion(result, "uniformity, immediate surrounding").required, 0.40);
    EXPECT_NEAR(criterion(result, "mean, background").required, k.surrounding / 3.0, 1e-9);
    EXPECT_EQ(criterion(result, "uniformity, background").required, 0.10);
    EXPECT_EQ(result.verdict, Verdict::kPass);
  }
}

TEST(En12464, TheWorstObserverCounts) {
  const GridResult task = grid({600, 600}, 0);
  ObserverResult good;
  good.observer.name = "good";
  good.ugr = 15.0;
  ObserverResult bad;
  bad.observer.name = "bad";
  bad.ugr = 22.0;
  bad.ugr_error = 0.1;
  TaskFindings findings;
  findings.areas[0] = &task;
  findings.observers = {&good, &bad};
  const TaskRequirements required{.task = "", .illuminance_lux = 500, .uniformity = 0.6, .ugr = 19};
  TaskResult result = judge(required, findings);
  EXPECT_EQ(criterion(result, "UGR").what, "UGR, observer 'bad'");
  EXPECT_EQ(criterion(result, "UGR").verdict, Verdict::kFail);
  bad.ugr = -std::numeric_limits<double>::infinity();
  good.ugr = bad.ugr;
  result = judge(required, findings);
  EXPECT_EQ(result.verdict, Verdict::kPass);
  EXPECT_THAT(result.remarks, Contains(HasSubstr("Nothing glares")));
}

TEST(En12464, WhatCannotBeJudgedIsNotPassed) {
  const GridResult task = grid({600, 600}, 0);
  TaskFindings findings;
  findings.areas[0] = &task;
  for (const TaskRequirements& required :
       {TaskRequirements{.task = "", .illuminance_lux = 500, .uniformity = 0.6, .ugr = 19},
        TaskRequirements{.task = "", .illuminance_lux = 500, .uniformity = 0.6, .walls_lux = 150}}) {
    const TaskResult result = judge(required, findings);
    EXPECT_EQ(result.verdict, Verdict::kUndecided);
    EXPECT_THAT(result.remarks, Contains(HasSubstr("not judged")));
  }
}

TEST(En12464, CylindricalIlluminanceAndModellingAreThoseOfTheActivity) {
  const GridResult task = grid({600, 600}, 0);
  GridResult activity = grid({500, 500}, 0);
  activity.cylindrical_lux = {160, 240};
  activity.cylindrical_error_lux = {1, 1};
  activity.metrics.mean_modelling = 0.7;
  TaskFindings findings;
  findings.areas[0] = &task;
  findings.areas[static_cast<std::size_t>(TaskArea::kActivity)] = &activity;
  const TaskResult result =
      judge({.task = "", .illuminance_lux = 500, .uniformity = 0.6, .cylindrical_lux = 150}, findings);
  EXPECT_DOUBLE_EQ(criterion(result, "mean, cylindrical").found, 200.0);
  EXPECT_EQ(criterion(result, "mean, cylindrical").verdict, Verdict::kPass);
  EXPECT_DOUBLE_EQ(criterion(result, "uniformity, cylindrical").found, 0.8);
  EXPECT_THAT(result.remarks, Contains(HasSubstr("outside the 0.30 to 0.60")));
}

}  // namespace
}  // namespace clerestory::lighting
