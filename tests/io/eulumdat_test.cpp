// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/eulumdat.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "tests/io/refusal.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using lighting::Photometry;
using lighting::web_of;
using testing::HasSubstr;
using Shape = lighting::LuminousOpening::Shape;

/// A file with planes every 90° and angles of 0, 90, 180°, plane k with `candela[k]` per 1000 lm throughout.
std::string file_of(int symmetry, const std::vector<double>& candela,
                    const std::string& lamps = "1\n1\nLED\n2000\n840\n80\n20\n") {
  std::string text = fmt::format("Maker\n2\n{}\n4\n90\n3\n90\nreport\nName\nNumber\nfile.ldt\ntoday\n", symmetry);
  text += "1500\n300\n80\n1200\n200\n10\n20\n30\n40\n100\n50\n1.0\n0\n" + lamps;
  for (int k = 0; k < 10; ++k) text += "0.5\n";
  text += "0\n90\n180\n270\n0\n90\n180\n";
  for (const double cd : candela) text += fmt::format("{0}\n{0}\n{0}\n", cd);
  return text;
}

Photometry read(const std::string& text, std::size_t lamp_set = 0) {
  const test::ScratchFolder scratch;
  test::write_text(scratch.path() / "lamp.ldt", text);
  return read_eulumdat(scratch.path() / "lamp.ldt", lamp_set);
}

std::string refusal(const std::string& text, std::size_t lamp_set = 0) {
  return test::refusal_of([&] { read(text, lamp_set); });
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(Eulumdat, ReadsWhatTheFileSays) {
  const Photometry p = read(file_of(1, {10}));
  EXPECT_EQ(p.format, "EULUMDAT");
  EXPECT_EQ(p.maker, "Maker");
  EXPECT_EQ(p.name, "Name");
  EXPECT_EQ(p.catalogue_number, "Number");
  EXPECT_EQ(p.opening.shape, Shape::kRectangle);
  EXPECT_DOUBLE_EQ(p.opening.y_m, 1.2);  // the length lies along C90
  EXPECT_DOUBLE_EQ(p.opening.x_m, 0.2);
  EXPECT_DOUBLE_EQ(p.opening.sides_m[1], 0.02);
  EXPECT_DOUBLE_EQ(p.opening.z_m, 0.04);
  EXPECT_DOUBLE_EQ(p.candela[0], 20.0);  // 10 cd/klm of 2000 lm
  EXPECT_DOUBLE_EQ(*p.stated_flux_lm, 1000.0);
  EXPECT_EQ(p.power_w, 20.0);
  EXPECT_NEAR(web_of(p).flux_lm(), 80.0 * std::numbers::pi, 1e-9);
}

TEST(Eulumdat, AllSymmetriesFillTheSphere) {
  const auto at = [](const Photometry& p, double c) { return web_of(p).intensity_cd(c, 90) / 2.0; };
  const Photometry none = read(file_of(0, {10, 20, 30, 40}));
  const Photometry c0 = read(file_of(2, {10, 20, 30}));
  const Photometry c90 = read(file_of(3, {10, 20, 30}));  // C270, C0, C90
  const Photometry both = read(file_of(4, {10, 20}));
  const double expected[4][4] = {{10, 20, 30, 40}, {10, 20, 30, 20}, {20, 30, 20, 10}, {10, 20, 10, 20}};
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(at(none, 90.0 * k), expected[0][k], 1e-9);
    EXPECT_NEAR(at(c0, 90.0 * k), expected[1][k], 1e-9);
    EXPECT_NEAR(at(c90, 90.0 * k), expected[2][k], 1e-9);
    EXPECT_NEAR(at(both, 90.0 * k), expected[3][k], 1e-9);
  }
}

TEST(Eulumdat, OneOfSeveralLampSetsIsFitted) {
  const std::string three = "3\n1\nA\n500\n\n\n10\n2\nB\n1200\n\n\n20\n-1\nC\n700\n\n\n\n";
  const Photometry second = read(file_of(1, {10}, three), 1);
  EXPECT_EQ(second.lamps.size(), 3U);
  EXPECT_DOUBLE_EQ(second.candela[0], 12.0);
  EXPECT_FALSE(second.absolute);
  EXPECT_TRUE(read(file_of(1, {10}, three), 2).absolute);
  EXPECT_THAT(refusal(file_of(1, {10}, three), 3), HasSubstr("the file has 3 lamp sets, no 4"));
}

TEST(Eulumdat, ConversionFactorCommasAndUnitsAreTaken) {
  const std::string text = replaced(file_of(1, {10}), "50\n1.0\n", "50\n1,5\n");
  EXPECT_DOUBLE_EQ(read(text).candela[0], 30.0);
  EXPECT_EQ(read(replaced(text, "80\n20\n", "80\n20,5 W\n")).power_w, 20.5);
}

TEST(Eulumdat, IsReadAsItIsFoundInTheWild) {
  std::string text;
  for (const char c : file_of(1, {10})) text += c == '\n' ? std::string("  \r\n") : std::string(1, c);
  text = "\xef\xbb\xbf" + replaced(text, "Name", "R\xfchrer");
  text.resize(text.size() - 4);  // no end of the last line
  EXPECT_EQ(read(text).name, "R\xc3\xbchrer");
  EXPECT_EQ(read(text + "\r\n\x1a").candela.size(), 3U);
}

TEST(Eulumdat, AWidthOfZeroIsRoundAndNoneIsAPoint) {
  EXPECT_EQ(read(replaced(file_of(1, {10}), "1200\n200\n", "120\n0\n")).opening.shape, Shape::kEllipse);
  const Photometry point = read(replaced(file_of(1, {10}), "1200\n200\n", "0\n0\n"));
  EXPECT_EQ(point.opening.shape, Shape::kPoint);
  EXPECT_THAT(point.notes.back(), HasSubstr("no luminous area"));
}

TEST(Eulumdat, BadFilesAreRefusedInALine) {
  const std::string good = file_of(0, {10, 20, 30, 40});
  EXPECT_THAT(refusal(""), HasSubstr("the file ends before the maker"));
  EXPECT_THAT(refusal(good.substr(0, good.size() - 3)), HasSubstr("the file ends before an intensity"));
  EXPECT_THAT(refusal(replaced(good, "0\n90\n180\n270\n", "0\n180\n90\n270\n")),
              HasSubstr("lamp.ldt:45: the angles are out of order: 90 after 180"));
  EXPECT_THAT(refusal(replaced(good, "10\n10\n10\n20\n", "10\n-1\n10\n20\n")),
              HasSubstr("an intensity cannot be '-1'"));
  EXPECT_THAT(refusal(file_of(0, {0, 0, 0, 0})), HasSubstr("add up to no light"));
  EXPECT_THAT(refusal(file_of(1, {10, 20})), HasSubstr("numbers follow after the last intensity"));
  EXPECT_THAT(refusal(replaced(good, "Maker\n2\n0\n4\n", "Maker\n2\n4\n6\n")),
              HasSubstr("6 planes cannot have the symmetry 4"));
  EXPECT_THAT(refusal(replaced(good, "Maker\n2\n0\n", "Maker\n2\nx\n")),
              HasSubstr("lamp.ldt:3: 'x' is no number, for the symmetry"));
  EXPECT_THAT(refusal(replaced(file_of(2, {10, 20, 30}), "0\n90\n180\n270\n", "0\n80\n170\n270\n")),
              HasSubstr("the planes must run from 0 to 180"));
}

}  // namespace
}  // namespace clerestory::io
