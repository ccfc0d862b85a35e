// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/ifc_samples.h"
#include "tests/io/refusal.h"
#include "tests/io/study_folder.h"

namespace clerestory::io {
namespace {

using lighting::Luminaire;
using testing::HasSubstr;

/// 10 cd towards C0, 20 cd towards C90, 30 and 40 cd towards C180 and C270; 1.2 m long, 0.3 m wide.
const std::string kIes =
    "IESNA:LM-63-2002\nTILT=INCLUDE\n1\n2\n0 90\n1 0.5\n1 -1 1 2 4 1 2 0.3 1.2 0\n1 1 20\n0 180\n0 90 180 270\n10 "
    "10\n20 20\n30 30\n40 40\n";

std::string ldt() {
  std::string text =
      "Maker\n2\n0\n4\n90\n2\n180\nr\nN\nN\nf\nd\n1200\n300\n80\n1200\n300\n0\n0\n0\n0\n100\n100\n1\n0\n1\n1\nLED\n1000"
      "\n0\n0\n20\n";
  for (int k = 0; k < 10; ++k) text += "0\n";
  text += "0\n90\n180\n270\n0\n180\n";
  for (const int cd : {10, 20, 30, 40}) text += fmt::format("{0}\n{0}\n", cd);
  return text;
}

class StudyLuminaires : public testing::Test {
 protected:
  StudyLuminaires() {
    test::write_text(folder_.path() / "lamp.ies", kIes);
    test::write_text(folder_.path() / "lamp.ldt", ldt());
  }
  [[nodiscard]] lighting::Study read(const std::string& lines, const ReadOptions& options = {}) const {
    return folder_.read("[model]\nfile = 'room.obj'\n" + lines, options).study;
  }
  [[nodiscard]] std::vector<Luminaire> luminaires(const std::string& lines) const {
    return read("[[luminaires]]\n" + lines).luminaires;
  }
  [[nodiscard]] std::string refusal(const std::string& lines) const {
    return test::refusal_of([&] { static_cast<void>(luminaires(lines)); });
  }

  test::StudyFolder folder_;
};

TEST_F(StudyLuminaires, HaveDefaultsForAllButFileAndPlace) {
  const auto all = luminaires("photometry = 'lamp.ies'\nat = [1, 2, 2.5]\n");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].at, (mesh::Point{1, 2, 2.5}));
  EXPECT_EQ(all[0].group, "lamps");
  EXPECT_DOUBLE_EQ(all[0].factor, 0.8);
  EXPECT_EQ(all[0].name, "lamp.ies");
}

TEST_F(StudyLuminaires, AsymmetricFilesStandByTheConventionOfTheirFormat) {
  for (const std::string file : {"lamp.ies", "lamp.ldt"}) {
    const auto all = luminaires("photometry = '" + file + "'\nat = [1, 2, 2.5]\nmaintenance = 1.0\n");
    // C0 towards +x, C90 towards +y in both.
    EXPECT_NEAR(all[0].intensity_cd({1, 0, 0}), 10.0, 1e-9) << file;
    EXPECT_NEAR(all[0].intensity_cd({0, 1, 0}), 20.0, 1e-9) << file;
    EXPECT_NEAR(all[0].intensity_cd({-1, 0, 0}), 30.0, 1e-9) << file;
    EXPECT_NEAR(all[0].intensity_cd({0, -1, 0}), 40.0, 1e-9) << file;
    const auto turned = luminaires("photometry = '" + file + "'\nat = [1, 2, 2.5]\nmaintenance = 1.0\nrotate = 90\n");
    EXPECT_NEAR(turned[0].intensity_cd({0, 1, 0}), 10.0, 1e-9) << file;
    EXPECT_NEAR(turned[0].intensity_cd({1, 0, 0}), 40.0, 1e-9) << file;
  }
  // The length lies along C0 in IES, along C90 in EULUMDAT.
  EXPECT_DOUBLE_EQ(luminaires("photometry = 'lamp.ies'\nat = [1, 2, 2.5]\n")[0].opening.x_m, 1.2);
  EXPECT_DOUBLE_EQ(luminaires("photometry = 'lamp.ldt'\nat = [1, 2, 2.5]\n")[0].opening.y_m, 1.2);
}

TEST_F(StudyLuminaires, StandInListsAndArrays) {
  EXPECT_EQ(luminaires("photometry = 'lamp.ies'\nat = [[1, 2, 2.5], [3, 2, 2.5]]\n").size(), 2U);
  const auto array =
      luminaires("photometry = 'lamp.ies'\nat = [1, 2, 2.5]\narray = { count = [3, 4], spacing = [2.0, 2.4] }\n");
  ASSERT_EQ(array.size(), 12U);
  EXPECT_EQ(array[2].at, (mesh::Point{5, 2, 2.5}));
  EXPECT_NEAR(array[11].at.y, 9.2, 1e-12);
  EXPECT_EQ(array[0].web, array[11].web);
}

TEST_F(StudyLuminaires, MaintenanceDimmingAndTiltMultiply) {
  const auto all =
      luminaires("photometry = 'lamp.ies'\nat = [1, 2, 2.5]\naim = [0, 1, -1]\nmaintenance = 0.5\ndimming = 0.5\n");
  EXPECT_NEAR(all[0].factor, 0.25 * 0.75, 1e-12);
}

TEST_F(StudyLuminaires, TiltTablesHoldForAnyGeometryOfTheLampAndAnyWayOfLeaning) {
  for (const std::string geometry : {"1", "2", "3"}) {
    std::string text = kIes;
    const std::size_t at = text.find("TILT=INCLUDE\n") + 13;
    ASSERT_NE(at, std::string::npos + 13);
    text.replace(at, text.find('\n', at) - at, geometry);
    test::write_text(folder_.path() / "tilted.ies", text);
    const std::string lamp = "photometry = 'tilted.ies'\nat = [1, 2, 2.5]\nmaintenance = 1.0\n";
    EXPECT_NEAR(luminaires(lamp)[0].factor, 1.0, 1e-12) << geometry;
    for (const std::string aim : {"[0, 1, -1]", "[1, 0, -1]", "[-1, 0, -1]"})
      EXPECT_NEAR(luminaires(lamp + "aim = " + aim + "\n")[0].factor, 0.75, 1e-12) << geometry << aim;
  }
}

TEST_F(StudyLuminaires, AreDarkForTheDaylightFactor) {
  const std::string lines = "[[luminaires]]\nphotometry = 'lamp.ies'\nat = [1, 2, 2.5]\n";
  EXPECT_TRUE(read(lines, {.kind = lighting::Study::Kind::kDaylight, .set = {}}).luminaires.empty());
}

TEST_F(StudyLuminaires, WhatIsWrongIsSaidInALine) {
  EXPECT_THAT(refusal("at = [1, 2, 2.5]\n"), HasSubstr("study.toml:3: these luminaires have no photometry"));
  EXPECT_THAT(refusal("photometry = 'lamp.ies'\n"), HasSubstr("these luminaires have no place"));
  EXPECT_THAT(refusal("photometry = 'none.ies'\nat = [1, 2, 2.5]\n"),
              HasSubstr("study.toml:4: there is no photometric file"));
  EXPECT_THAT(refusal("photometry = 'lamp.ies'\nat = [1, 2]\n"), HasSubstr("expected 3 numbers"));
  EXPECT_THAT(refusal("photometry = 'lamp.ies'\nat = [1, 2, 2.5]\naim = [0, 0, 0]\n"),
              HasSubstr("the aim of these luminaires is zero"));
  EXPECT_THAT(refusal("photometry = 'lamp.ies'\nat = [1, 2, 2.5]\narray = { count = [2, 0], spacing = [1, 1] }\n"),
              HasSubstr("0 is no count"));
  EXPECT_THAT(refusal("photometry = 'lamp.ies'\nat = [1, 2, 2.5]\narray = { count = [2, 2] }\n"),
              HasSubstr("an array has count and spacing"));
  EXPECT_THAT(refusal("photometry = 'lamp.ies'\nat = [1, 2, 2.5]\nlamp_set = 2\n"), HasSubstr("one lamp set"));
  EXPECT_THAT(refusal("photometry = 'lamp.ies'\nat = [1, 2, 2.5]\ngroup = 'a,b'\n"), HasSubstr("cannot name a column"));
}

class StudyFixtures : public StudyLuminaires {
 protected:
  StudyFixtures() {
    test::write_text(folder_.path() / "house.ifc",
                     test::ifc_text(test::kIfcFrame + test::kIfcWall + test::kIfcFixtures));
  }
  [[nodiscard]] lighting::Study read_house(const std::string& lines) const {
    return folder_.read("[model]\nfile = 'house.ifc'\n" + lines).study;
  }
};

TEST_F(StudyFixtures, OfAnIfcFileShineByTheFileOfTheirType) {
  const auto study =
      read_house("[fixtures.'Panel*']\nphotometry = 'lamp.ies'\noffset = [0, 0, -0.1]\ngroup = 'ceiling'\n");
  ASSERT_EQ(study.luminaires.size(), 2U);
  EXPECT_NEAR(study.luminaires[0].at.x, 0.5, 1e-12);
  EXPECT_NEAR(study.luminaires[0].at.z, 2.7, 1e-12);
  EXPECT_EQ(study.luminaires[0].group, "ceiling");
  EXPECT_DOUBLE_EQ(study.luminaires[0].factor, 0.8);
  EXPECT_NEAR(study.luminaires[0].axes.u.x, 1.0, 1e-12);
  EXPECT_NEAR(study.luminaires[0].axes.w.z, 1.0, 1e-12);
  // The second is turned by a quarter: what shone along x shines along y.
  EXPECT_NEAR(study.luminaires[1].axes.u.y, 1.0, 1e-12);
  EXPECT_NEAR(study.luminaires[1].intensity_cd({0, 1, 0}), study.luminaires[0].intensity_cd({1, 0, 0}), 1e-9);
}

TEST_F(StudyFixtures, RotateTurnsThemFromC0ToC90) {
  const auto study = read_house("[fixtures.'Panel 600']\nphotometry = 'lamp.ies'\nrotate = 90\n");
  ASSERT_EQ(study.luminaires.size(), 2U);
  EXPECT_NEAR(study.luminaires[0].axes.u.y, 1.0, 1e-12);
  EXPECT_NEAR(study.luminaires[0].axes.v.x, -1.0, 1e-12);
}

TEST_F(StudyFixtures, WithoutAnEntryStayDarkAndAreTold) {
  const auto study = read_house("");
  EXPECT_TRUE(study.luminaires.empty());
  EXPECT_THAT(study.assumptions, testing::Contains(HasSubstr("The 2 light fixtures of the type 'Panel 600'")));
}

TEST_F(StudyFixtures, OfATypeThatTheModelLacksAreRefused) {
  const auto told = test::refusal_of([&] { (void)read_house("[fixtures.'Spot*']\nphotometry = 'lamp.ies'\n"); });
  EXPECT_THAT(told, HasSubstr("no light fixture of the type 'Spot*'"));
  EXPECT_THAT(told, HasSubstr("Panel 600"));
}

}  // namespace
}  // namespace clerestory::io
