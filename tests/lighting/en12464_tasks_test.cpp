// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/en12464_tasks.h"

#include <gtest/gtest.h>

#include <set>

namespace clerestory::lighting {
namespace {

TEST(En12464Tasks, WritingInOfficesAsksFor500LuxOf060AndUgr19) {
  const StandardTask* task = find_task("office-writing");
  ASSERT_NE(task, nullptr);
  const TaskRequirements required = requirements_of(*task);
  EXPECT_EQ(required.illuminance_lux, 500.0);
  EXPECT_EQ(required.uniformity, 0.60);
  EXPECT_EQ(required.ugr, 19.0);
  EXPECT_EQ(required.cylindrical_lux, 150.0);
  EXPECT_EQ(required.walls_lux, 150.0);
  EXPECT_EQ(required.ceiling_lux, 100.0);
}

TEST(En12464Tasks, WordsAreUniqueAndUnknownOnesAreNotFound) {
  std::set<std::string_view> words;
  for (const StandardTask& task : standard_tasks()) EXPECT_TRUE(words.insert(task.word).second) << task.word;
  EXPECT_EQ(find_task("knitting"), nullptr);
}

}  // namespace
}  // namespace clerestory::lighting
