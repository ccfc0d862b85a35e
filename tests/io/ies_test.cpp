// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ies.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/io/refusal.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using lighting::Photometry;
using lighting::web_of;
using testing::HasSubstr;
using Shape = lighting::LuminousOpening::Shape;
using Symmetry = Photometry::Symmetry;

/// A lamp of 100 cd below the horizon, in the words of a year.
constexpr const char* k2002 =
    "IESNA:LM-63-2002\n[TEST] 1\n[MANUFAC] Maker\n[LUMINAIRE] Lamp\n[MORE] of glass\n[LUMCAT] L1\nTILT=NONE\n"
    "1 -1 1 2 1 1 2 0.3 1.2 0\n1 1 20\n0 90\n0\n100 100\n";

Photometry read(const std::string& text) {
  const test::ScratchFolder scratch;
  test::write_text(scratch.path() / "lamp.ies", text);
  return read_ies(scratch.path() / "lamp.ies");
}

std::string refusal(const std::string& text) {
  return test::refusal_of([&] { read(text); });
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(Ies, ReadsWhatTheFileSays) {
  const Photometry p = read(k2002);
  EXPECT_EQ(p.format, "IESNA:LM-63-2002");
  EXPECT_EQ(p.name, "Lamp of glass");
  EXPECT_EQ(p.maker, "Maker");
  EXPECT_EQ(p.catalogue_number, "L1");
  EXPECT_TRUE(p.absolute);
  EXPECT_EQ(p.power_w, 20.0);
  EXPECT_EQ(p.opening.shape, Shape::kRectangle);
  EXPECT_EQ(p.opening.x_m, 1.2);  // the length lies along C0
  EXPECT_EQ(p.opening.y_m, 0.3);
  EXPECT_NEAR(web_of(p).flux_lm(), 200.0 * std::numbers::pi, 1e-9);
}

TEST(Ies, FirstLinesOfAllYearsAreKnown) {
  for (const char* line : {"IESNA86", "IESNA91", "IESNA:LM-63-1995", "IESNA:LM-63-2002", "IES:LM-63-2019"}) {
    const Photometry p = read(replaced(k2002, "IESNA:LM-63-2002", line));
    EXPECT_EQ(p.format, line);
    EXPECT_TRUE(p.notes.empty()) << line;
  }
  EXPECT_THAT(read(replaced(k2002, "IESNA:LM-63-2002", "IESNA:LM-63-2051")).notes.at(0), HasSubstr("no known edition"));
}

TEST(Ies, Of1986HasNoFormatLineAndABallastLampFactor) {
  const Photometry p =
      read("A lamp of 1986\nsold by nobody\nTILT=NONE\n2 1000 0.5 2 1 1 1 -1 0 0\n0.9 0.8 20\n0 90\n0\n100 100\n");
  EXPECT_EQ(p.format, "LM-63-1986");
  EXPECT_EQ(p.name, "A lamp of 1986");
  EXPECT_NEAR(p.candela[0], 100.0 * 0.5 * 0.9 * 0.8, 1e-12);
  EXPECT_FALSE(p.absolute);
  EXPECT_NEAR(p.lamps[0].flux_lm, 2000.0 * 0.9, 1e-9);
  EXPECT_EQ(p.opening.shape, Shape::kEllipse);
  EXPECT_NEAR(p.opening.x_m, 0.3048, 1e-12);
}

TEST(Ies, OldFilesApplyTheBallastLampFactorNewOnesDoNot) {
  const std::string changed = replaced(k2002, "1 1 20", "0.9 0.8 20");
  EXPECT_NEAR(read(changed).candela[0], 90.0, 1e-12);
  EXPECT_NEAR(read(replaced(changed, "IESNA:LM-63-2002", "IESNA91")).candela[0], 72.0, 1e-12);
  // In 2019 the field tells how the file was made.
  EXPECT_TRUE(
      read(replaced(replaced(k2002, "1 1 20", "1 1.00001 20"), "IESNA:LM-63-2002", "IES:LM-63-2019")).notes.empty());
}

TEST(Ies, TiltIsReadFromTheFileOrBesideIt) {
  const std::string table = "1\n3\n0 45 90\n1.0 0.95 0.9\n";
  const Photometry own = read(replaced(k2002, "TILT=NONE\n", "TILT=INCLUDE\n" + table));
  ASSERT_TRUE(own.tilt);
  EXPECT_EQ(own.tilt->lamp_geometry, 1);
  EXPECT_NEAR(own.tilt->at(22.5), 0.975, 1e-12);
  const test::ScratchFolder scratch;
  test::write_text(scratch.path() / "lamp.ies", replaced(k2002, "TILT=NONE", "TILT=TILT.DAT"));
  EXPECT_THAT(test::refusal_of([&] { read_ies(scratch.path() / "lamp.ies"); }),
              HasSubstr("lamp.ies:7: there is no tilt file"));
  test::write_text(scratch.path() / "TILT.DAT", table);
  EXPECT_EQ(read_ies(scratch.path() / "lamp.ies").tilt->multipliers.at(2), 0.9);
  EXPECT_THAT(refusal(replaced(k2002, "TILT=NONE\n", "TILT=INCLUDE\n1\n2\n45 0\n1 1\n")),
              HasSubstr("tilt angles are out of order"));
}

TEST(Ies, RangesOfPlanesTellTheSymmetry) {
  const auto with = [](const std::string& horizontals, int count) {
    std::string text = replaced(k2002, "2 1 1 2 0.3", "2 " + std::to_string(count) + " 1 2 0.3");
    std::string values;
    for (int k = 0; k < count; ++k) values += "100 100\n";
    return replaced(text, "0\n100 100\n", horizontals + "\n" + values);
  };
  EXPECT_EQ(read(with("0", 1)).symmetry, Symmetry::kAboutAxis);
  EXPECT_EQ(read(with("0 45 90", 3)).symmetry, Symmetry::kQuadrants);
  EXPECT_EQ(read(with("0 90 180", 3)).symmetry, Symmetry::kMirrorC0);
  EXPECT_EQ(read(with("90 180 270", 3)).symmetry, Symmetry::kMirrorC90);
  EXPECT_EQ(read(with("0 90 180 270 360", 5)).symmetry, Symmetry::kNone);
  EXPECT_EQ(read(with("0 90 180 270", 4)).symmetry, Symmetry::kNone);
  for (const char* planes : {"0 45 90", "0 90 180", "90 180 270"})
    EXPECT_NEAR(web_of(read(with(planes, 3))).flux_lm(), 200.0 * std::numbers::pi, 1e-9) << planes;
}

TEST(Ies, TypesAAndBAreRead) {
  const std::string a =
      "IESNA:LM-63-1995\nTILT=NONE\n1 -1 1 3 3 3 2 0 0 0\n1 1 5\n-90 0 90\n-90 0 90\n1 2 3 4 5 6 7 8 9\n";
  const Photometry type_a = read(a);
  EXPECT_EQ(type_a.type, Photometry::Type::kA);
  EXPECT_NEAR(web_of(type_a).intensity_cd({1, 0, 0}), 5.0, 1e-9);
  const std::string b = "IESNA:LM-63-1995\nTILT=NONE\n1 -1 1 2 2 2 2 0 0 0\n1 1 5\n0 90\n0 90\n40 20\n40 20\n";
  const Photometry type_b = read(b);
  EXPECT_EQ(type_b.type, Photometry::Type::kB);
  EXPECT_EQ(type_b.vertical_deg, (std::vector<double>{-90, 0, 90}));
  EXPECT_NEAR(web_of(type_b).intensity_cd({0, 0, -1}), 40.0, 1e-9);
  EXPECT_NEAR(web_of(type_b).intensity_cd({-1, 0, 0}), 20.0, 1e-9);
}

TEST(Ies, IsReadAsItIsFoundInTheWild) {
  // A byte-order mark, CRLF, commas between numbers, broken lines, no end of the last one, Latin-1 in a name.
  const Photometry p = read(
      "\xef\xbb\xbfIESNA:LM-63-2002\r\n[LUMINAIRE] R\xfchrer\r\nTILT = "
      "none\r\n1,-1,1,2,\r\n1,1,2,0,0,0\r\n1,1\r\n20\r\n0,90\r\n0\r\n100\r\n100");
  EXPECT_EQ(p.name, "R\xc3\xbchrer");
  EXPECT_EQ(p.candela, (std::vector<double>{100, 100}));
}

TEST(Ies, BadFilesAreRefusedInALine) {
  EXPECT_THAT(refusal(""), HasSubstr("lamp.ies: the file is empty"));
  EXPECT_THAT(refusal("IESNA:LM-63-2002\n[TEST] x\n"), HasSubstr("there is no line TILT="));
  EXPECT_THAT(refusal(std::string(k2002).substr(0, std::string(k2002).size() - 5)),
              HasSubstr("the file ends before an intensity"));
  EXPECT_THAT(refusal(replaced(k2002, "0 90\n", "90 0\n")),
              HasSubstr("lamp.ies:10: the vertical angles are out of order: 0 after 90"));
  EXPECT_THAT(refusal(replaced(k2002, "100 100", "100 -5")), HasSubstr("lamp.ies:12: an intensity cannot be '-5'"));
  EXPECT_THAT(refusal(replaced(k2002, "100 100", "0 0")), HasSubstr("add up to no light"));
  EXPECT_THAT(refusal(replaced(k2002, "100 100", "100 100 100")), HasSubstr("numbers follow after the last intensity"));
  EXPECT_THAT(refusal(replaced(k2002, "1 -1 1 2 1 1 2", "1 -1 1 2.5 1 1 2")), HasSubstr("is no whole number"));
  EXPECT_THAT(refusal(replaced(k2002, "1 -1 1 2 1 1 2", "1 -1 1 2 1 1 7")),
              HasSubstr("the unit of length cannot be '7'"));
  EXPECT_THAT(refusal(replaced(k2002, "1 -1 1 2 1 1 2", "1 -1 nan 2 1 1 2")), HasSubstr("'nan' is no number"));
}

}  // namespace
}  // namespace clerestory::io
