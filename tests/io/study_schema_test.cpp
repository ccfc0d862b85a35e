// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study_schema.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "io/study_tree.h"
#include "tests/support/places.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

TEST(StudySchema, ThePageInDocsIsThatOfTheReader) {
  const auto page = test::source_dir() / "docs" / "study-file.md";
  if (std::getenv("CLERESTORY_UPDATE_DOCS") != nullptr) test::write_text(page, study_page());
  EXPECT_EQ(test::read_text(page), study_page())
      << "run this test with CLERESTORY_UPDATE_DOCS=1 to write the page anew";
}

TEST(StudySchema, EachKeyStandsOnceAndBehindItsTable) {
  std::set<std::string_view> seen;
  for (const StudyKey& key : study_keys()) {
    EXPECT_TRUE(seen.insert(key.path).second) << key.path;
    const std::size_t dot = key.path.rfind('.');
    EXPECT_TRUE(dot == std::string_view::npos || seen.contains(key.path.substr(0, dot))) << key.path;
    EXPECT_FALSE(key.meaning.empty()) << key.path;
  }
}

TEST(StudySchema, DefaultsPassTheirOwnCheck) {
  StudyValue study;
  fill_defaults(study);
  EXPECT_NO_THROW(check_study(study, lighting::Study::Kind::kIlluminance));
  ASSERT_NE(study.find("grids"), nullptr);
  EXPECT_EQ(study.find("grids")->children.size(), 1U);
  EXPECT_EQ(study.find("accuracy")->find("target")->number, 0.02);
}

TEST(StudySchema, DefaultsAreThoseOfTheStudyInMemory) {
  StudyValue tree;
  fill_defaults(tree);
  const lighting::Study study;
  const lighting::GridRequest grid;
  EXPECT_EQ(tree.find("sky")->find("horizontal_illuminance")->number, study.sky.horizontal_illuminance_lux);
  EXPECT_EQ(tree.find("sky")->find("ground_reflectance")->number, study.sky.ground_reflectance);
  EXPECT_EQ(tree.find("accuracy")->find("target")->number, study.accuracy.target);
  EXPECT_EQ(tree.find("model")->find("north")->number, study.north_deg);
  EXPECT_EQ(tree.find("grids")->children[0].find("height")->number, grid.height_m);
  EXPECT_EQ(tree.find("grids")->children[0].find("spacing")->number, grid.spacing_m);
  EXPECT_EQ(tree.find("grids")->children[0].find("name")->text, grid.name);
}

}  // namespace
}  // namespace clerestory::io
