// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/io/ifc_samples.h"
#include "tests/io/study_folder.h"

namespace clerestory::io {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// A wall whose file puts true north at 30 degrees, and the building at 48.135 degrees north, 11.5 west.
class SiteFolder {
 public:
  SiteFolder() { test::write_text(path() / "wall.ifc", test::ifc_text(test::kIfcFrame + test::kIfcWall)); }

  [[nodiscard]] std::filesystem::path path() const { return scratch_.path(); }
  [[nodiscard]] StudyInput read(const std::string& more) const {
    test::write_text(path() / "study.toml", "[model]\nfile = 'wall.ifc'\n" + more);
    return read_study(path() / "study.toml", {.kind = lighting::Study::Kind::kDaylight, .set = {}});
  }

 private:
  test::ScratchFolder scratch_;
};

nlohmann::json table(const StudyInput& input, const char* name) {
  return nlohmann::json::parse(input.effective_json)[name];
}

TEST(StudySite, NorthAndPlaceAreTheModelFilesWhereTheStudySaysNothing) {
  const SiteFolder folder;
  const StudyInput input = folder.read("");
  EXPECT_NEAR(input.study.north_deg, 30.0, 1e-9);
  EXPECT_NEAR(table(input, "model")["north"].get<double>(), 30.0, 1e-9);
  EXPECT_NEAR(table(input, "site")["latitude"].get<double>(), 48.135, 1e-9);
  EXPECT_NEAR(table(input, "site")["longitude"].get<double>(), -11.5, 1e-9);
  EXPECT_THAT(input.study.assumptions, Contains(HasSubstr("True north is 30.00 degrees")).Times(1));
  EXPECT_THAT(input.study.assumptions, Contains(HasSubstr("latitude 48.1350 and longitude -11.5000")).Times(1));
}

TEST(StudySite, AModelAloneIsTurnedToo) {
  const SiteFolder folder;
  EXPECT_NEAR(read_study(folder.path() / "wall.ifc").study.north_deg, 30.0, 1e-9);
}

TEST(StudySite, TheStudysOwnValuesWinInSilence) {
  const SiteFolder folder;
  const StudyInput input = folder.read("north = 0\n[site]\nlatitude = 51.5\ntimezone = 1\n");
  EXPECT_EQ(input.study.north_deg, 0.0);
  EXPECT_EQ(table(input, "site")["latitude"], 51.5);
  EXPECT_FALSE(table(input, "site").contains("longitude"));  // half of a place is not mixed with another
  EXPECT_THAT(input.study.assumptions, Not(Contains(HasSubstr("north"))));
  EXPECT_THAT(input.study.assumptions, Not(Contains(HasSubstr("latitude"))));
}

TEST(StudySite, ATimezoneLeavesThePlaceToTheModel) {
  const SiteFolder folder;
  EXPECT_NEAR(table(folder.read("[site]\ntimezone = 1\n"), "site")["longitude"].get<double>(), -11.5, 1e-9);
}

TEST(StudySite, AModelWithoutPlaceIsNotGivenOne) {
  const test::StudyFolder folder;
  const StudyInput input = read_study(folder.model());
  EXPECT_EQ(input.study.north_deg, 0.0);
  EXPECT_TRUE(table(input, "site").is_null());
  EXPECT_THAT(input.study.assumptions, Not(Contains(HasSubstr("north"))));
}

}  // namespace
}  // namespace clerestory::io
