// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/error.h"
#include "tests/io/study_folder.h"

namespace clerestory::io {
namespace {

using test::StudyFolder;
using testing::HasSubstr;

constexpr const char* kModel = "[model]\nfile = 'room.obj'\n";

lighting::Study read(const StudyFolder& folder, const std::string& rest, const ReadOptions& options = {}) {
  return folder.read(kModel + rest, options).study;
}

std::string refusal(const std::string& rest) {
  const StudyFolder folder;
  try {
    read(folder, rest);
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(StudyTasks, ATaskHasTheRequirementsOfTheListAndThoseOfTheStudyInTheirPlace) {
  const StudyFolder folder;
  const auto study = read(folder,
                          "[[tasks]]\ntask = 'office-writing'\nugr = 16\n"
                          "[[tasks]]\nname = 'bench'\nilluminance = 750\nuniformity = 0.7\nheight = 0.9\n"
                          "rectangle = [[2, 3], [1, 5]]\nrooms = 'Lab*'\n");
  ASSERT_EQ(study.tasks.size(), 2U);
  EXPECT_EQ(study.tasks[0].name, "task");
  EXPECT_EQ(study.tasks[0].required.illuminance_lux, 500.0);
  EXPECT_EQ(study.tasks[0].required.ugr, 16.0);
  EXPECT_FALSE(study.tasks[0].rectangle.has_value());
  EXPECT_EQ(study.tasks[0].height_m, 0.75);
  EXPECT_EQ(study.tasks[0].eye_height_m, 1.2);
  EXPECT_EQ(study.tasks[1].required.illuminance_lux, 750.0);
  EXPECT_EQ(study.tasks[1].required.ugr, 0.0);
  EXPECT_EQ(study.tasks[1].rooms, "Lab*");
  ASSERT_TRUE(study.tasks[1].rectangle.has_value());
  EXPECT_EQ(study.tasks[1].rectangle->low.x, 1.0);
  EXPECT_EQ(study.tasks[1].rectangle->high.y, 5.0);
}

TEST(StudyTasks, ObserversHaveAnEyeAndALineOfSight) {
  const StudyFolder folder;
  const auto study =
      read(folder, "[[observers]]\nat = [1, 2, 1.2]\n[[observers]]\nname = 'b'\nat = [1, 2, 1.6]\nlook = [3, 0, -4]\n");
  ASSERT_EQ(study.observers.size(), 2U);
  EXPECT_EQ(study.observers[0].name, "observer 1");
  EXPECT_EQ(study.observers[0].look.y, 1.0);
  EXPECT_NEAR(study.observers[1].look.z, -0.8, 1e-12);
}

TEST(StudyTasks, TheDaylightFactorHasNeither) {
  const StudyFolder folder;
  const auto study = read(folder, "[[observers]]\nat = [1, 2, 1.2]\n[[tasks]]\ntask = 'meeting'\n",
                          {.kind = lighting::Study::Kind::kDaylight, .set = {}});
  EXPECT_TRUE(study.observers.empty());
  EXPECT_TRUE(study.tasks.empty());
}

TEST(StudyTasks, WhatAsksNothingOrHasNoPlaceIsRefused) {
  EXPECT_THAT(refusal("[[tasks]]\nname = 'a'\n"), HasSubstr("study.toml:3: this task asks for no illuminance"));
  EXPECT_THAT(refusal("[[tasks]]\ntask = 'knitting'\n"), HasSubstr("expected one of corridor"));
  EXPECT_THAT(refusal("[[tasks]]\ntask = 'meeting'\nrectangle = [[1, 1], [1, 2]]\n"), HasSubstr("no area"));
  EXPECT_THAT(refusal("[[tasks]]\ntask = 'meeting'\nrectangle = [1, 2]\n"), HasSubstr("expected 2 numbers"));
  EXPECT_THAT(refusal("[[tasks]]\nname = 'workplane'\ntask = 'meeting'\n"), HasSubstr("two tasks have the name"));
  EXPECT_THAT(refusal("[[tasks]]\nname = 'observers'\ntask = 'meeting'\n"), HasSubstr("belongs to another result"));
  EXPECT_THAT(refusal("[[observers]]\nname = 'a'\n"), HasSubstr("no place"));
  EXPECT_THAT(refusal("[[observers]]\nat = [1, 2]\n"), HasSubstr("expected 3 numbers"));
  EXPECT_THAT(refusal("[[observers]]\nat = [1, 2, 3]\nlook = [0, 0, 0]\n"), HasSubstr("is zero"));
}

}  // namespace
}  // namespace clerestory::io
