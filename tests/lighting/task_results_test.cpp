// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/task_results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lighting/run.h"
#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(TaskResults, ARunJudgesATaskByItsOwnGridsAndObservers) {
  Study study = test::study_of(support::box_room(4, 5, 3), 0.5, {2, 2, 1});
  Luminaire lamp = clerestory::test::lambertian_lamp({2, 2.5, 2.95}, {0, 0, -1}, 3000.0);
  lamp.opening = {.shape = LuminousOpening::Shape::kRectangle, .x_m = 0.6, .y_m = 0.6};
  lamp.power_w = 100.0;
  study.luminaires.push_back(lamp);
  TaskRequest task;
  task.name = "reading";
  task.required = {.task = "reading", .illuminance_lux = 200, .uniformity = 0.9, .ugr = 5, .cylindrical_lux = 50};
  study.tasks.push_back(task);
  study.accuracy.target = 0.05;
  NoProgress nobody;
  const Results results = run(study, nobody);
  ASSERT_EQ(results.tasks.size(), 1U);
  const TaskResult& result = results.tasks[0];
  EXPECT_EQ(result.name, "reading");
  EXPECT_EQ(result.observers.size(), 4U);
  EXPECT_THAT(result.grids, Contains("reading activity"));
  EXPECT_THAT(result.grids, Contains("reading walls"));
  EXPECT_EQ(result.criteria[0].verdict, Criterion::Verdict::kPass);  // of the mean
  EXPECT_EQ(result.criteria[1].verdict, Criterion::Verdict::kFail);  // of the uniformity
  EXPECT_EQ(result.criteria.back().verdict, Criterion::Verdict::kFail);
  EXPECT_THAT(result.criteria.back().what, HasSubstr("UGR"));
  EXPECT_THAT(result.remarks, Contains(HasSubstr("whole room")));
  EXPECT_NEAR(result.power_w_m2_per_100_lux, 100.0 * 5.0 / result.criteria[0].found, 0.05);
}

}  // namespace
}  // namespace clerestory::lighting
