// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/task_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clerestory::tools {
namespace {

using testing::HasSubstr;

TEST(TaskReport, SaysNothingWhereThereIsNothing) { EXPECT_EQ(task_report({}), ""); }

TEST(TaskReport, JudgesInWords) {
  lighting::Results results;
  lighting::TaskResult& task = results.tasks.emplace_back();
  task.name = "writing";
  task.task = "offices";
  task.room = "hall";
  task.criteria.push_back({.what = "mean, task area",
                           .unit = "lx",
                           .required = 500,
                           .found = 545,
                           .error = 3,
                           .verdict = lighting::Criterion::Verdict::kPass});
  task.remarks = {"Said so."};
  const std::string text = task_report(results);
  EXPECT_THAT(text, HasSubstr("writing, EN 12464-1:2021, offices, in hall: not decided\n"));
  EXPECT_THAT(text, HasSubstr("≥ 500 lx"));
  EXPECT_THAT(text, HasSubstr("pass"));
  EXPECT_THAT(text, HasSubstr("  Said so.\n"));
}

TEST(TaskReport, TellsWhichOfSeveralMomentsIsJudged) {
  lighting::Results results;
  lighting::TaskResult& task = results.tasks.emplace_back();
  task.name = "writing";
  task.task = "offices";
  task.room = "hall";
  task.moment = "2026-03-21T0900";
  lighting::ObserverResult& observer = results.observers.emplace_back();
  observer.observer.name = "desk";
  observer.moment = "2026-03-21T0900";
  const std::string text = task_report(results);
  EXPECT_THAT(text, HasSubstr("writing at 2026-03-21T0900, EN 12464-1:2021, offices, in hall"));
  EXPECT_THAT(text, HasSubstr("desk_2026-03-21T0900"));
}

TEST(TaskReport, ListsLuminairesAndObservers) {
  lighting::Results results;
  results.luminaires = {{"panel.ldt", "row", 4, 12800.0, 128.0}};
  results.room_power = {{"hall", 0, 4, 128.0, 2.0}};
  lighting::ObserverResult& observer = results.observers.emplace_back();
  observer.observer.name = "desk";
  observer.ugr = 18.26;
  const std::string text = task_report(results);
  EXPECT_THAT(text, HasSubstr("hall: 128 W installed, 2.00 W/m²\n"));
  EXPECT_THAT(text, HasSubstr("18.3"));
}

}  // namespace
}  // namespace clerestory::tools
