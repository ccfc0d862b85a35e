// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "mesh/error.h"
#include "tests/io/study_folder.h"

namespace clerestory::io {
namespace {

using lighting::Columns;

const std::string kModel = "[model]\nfile = 'room.obj'\n";

TEST(StudyResults, NothingIsGivenApartUnlessAskedFor) {
  EXPECT_EQ(test::StudyFolder().read(kModel).study.columns, Columns::kMix);
}

TEST(StudyResults, ColumnsAreThoseAskedFor) {
  const test::StudyFolder folder;
  const auto columns = [&](const std::string& word) {
    return folder.read(kModel + "[results]\ncolumns = '" + word + "'\n").study.columns;
  };
  EXPECT_EQ(columns("groups"), Columns::kGroups);
  EXPECT_EQ(columns("sky-145"), Columns::kSky145);
  EXPECT_EQ(columns("sky-577"), Columns::kSky577);
  EXPECT_THROW(columns("sky-146"), InputError);
}

TEST(StudyResults, SurfacesNameTheirGroupAndGroupsAreDimmed) {
  const lighting::Study study =
      test::StudyFolder()
          .read(kModel +
                "[materials.floor]\nreflectance = 0\nemission = { flux_lm = 10, group = 'a' }\n"
                "[groups.a]\ndimming = 0.25\n")
          .study;
  EXPECT_EQ(study.materials[0].front.emission->group, "a");
  ASSERT_EQ(study.dimming.size(), 1U);
  EXPECT_EQ(study.dimming[0].group, "a");
  EXPECT_EQ(study.dimming[0].share, 0.25);
}

TEST(StudyResults, TheDaylightFactorHasNoLampsToDim) {
  const test::StudyFolder folder;
  const ReadOptions daylight{.kind = lighting::Study::Kind::kDaylight, .set = {}};
  EXPECT_TRUE(folder.read(kModel + "[groups.a]\ndimming = 0.25\n", daylight).study.dimming.empty());
}

TEST(StudyResults, NamesThatNoColumnCanBearAreRefused) {
  const test::StudyFolder folder;
  for (const std::string name : {"a,b", "", " a", "sky", "sky-7", "ground", "sun"}) {
    EXPECT_THROW(folder.read_materials("floor = { emission = { flux_lm = 1, group = '" + name + "' } }\n"), InputError)
        << name;
  }
}

}  // namespace
}  // namespace clerestory::io
