// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance_xform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/error.h"
#include "tests/io/refusal.h"

namespace clerestory::io {
namespace {

using test::refusal_of;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> no_lines(const std::string&) { return {}; }

RadianceInclude parsed(const std::string& command) { return parse_radiance_command(command, {"a.rad", 7}, &no_lines); }

std::string refusal(const std::string& command) {
  return refusal_of([&] { parsed(command); });
}

void expect_at(const mesh::Point& p, double x, double y, double z) {
  EXPECT_NEAR(p.x, x, 1e-12);
  EXPECT_NEAR(p.y, y, 1e-12);
  EXPECT_NEAR(p.z, z, 1e-12);
}

TEST(RadianceXform, StepsApplyInTheirOrder) {
  const auto copies = parsed("xform -n desk -rz 90 -t 1 2 3 -s 2 desk.rad").copies;
  ASSERT_EQ(copies.size(), 1U);
  expect_at(copies[0].transform({1.0, 0.0, 0.0}), 2.0, 6.0, 6.0);
  EXPECT_EQ(copies[0].transform.scale, 2.0);
  EXPECT_EQ(copies[0].name, "desk");
  EXPECT_THAT(copies[0].files, ElementsAre("desk.rad"));
}

TEST(RadianceXform, RotationsRunCounterClockwiseAboutEachAxis) {
  expect_at(parsed("xform -rx 90 a").copies[0].transform({0.0, 1.0, 0.0}), 0.0, 0.0, 1.0);
  expect_at(parsed("xform -ry 90 a").copies[0].transform({0.0, 0.0, 1.0}), 1.0, 0.0, 0.0);
  expect_at(parsed("xform -rz 90 a").copies[0].transform({1.0, 0.0, 0.0}), 0.0, 1.0, 0.0);
}

TEST(RadianceXform, MirrorsHaveANegativeScale) {
  const RadianceTransform mirror = parsed("xform -mx -s 3 a").copies[0].transform;
  expect_at(mirror({1.0, 1.0, 1.0}), -3.0, 3.0, 3.0);
  EXPECT_EQ(mirror.scale, -3.0);
  EXPECT_EQ(parsed("xform -mx -my a").copies[0].transform.scale, 1.0);
}

// The example of xform(1): 5 by 4 lights, turned first and moved last.
TEST(RadianceXform, ArraysRepeatStepsAndNumberTheCopies) {
  const auto copies = parsed("xform -rz 90 -a 5 -t 2 0 0 -a 4 -t 0 1.5 0 -i 1 -t 0 0 10 light").copies;
  ASSERT_EQ(copies.size(), 20U);
  expect_at(copies[0].transform({1.0, 0.0, 0.0}), 0.0, 1.0, 10.0);
  expect_at(copies[19].transform({1.0, 0.0, 0.0}), 8.0, 5.5, 10.0);
  EXPECT_EQ(copies[19].numbers, ".4.3");
  EXPECT_EQ(parsed("xform -n row -a 3 -t 1 0 0 a").copies[2].name, "row.2");
}

TEST(RadianceXform, TheNewModifierAndTheInversionAreKept) {
  const RadianceCopy copy = parsed("xform -I -m paint -c a").copies[0];
  EXPECT_EQ(copy.modifier, "paint");
  EXPECT_TRUE(copy.inverted);
}

TEST(RadianceXform, ABarPutsOneTransformBehindAnother) {
  const auto copies = parsed("xform -n in -t 1 0 0 a b | xform -n out -rz 90").copies;
  ASSERT_EQ(copies.size(), 1U);
  expect_at(copies[0].transform({0.0, 0.0, 0.0}), 0.0, 1.0, 0.0);
  EXPECT_EQ(copies[0].name, "out.in");
  EXPECT_THAT(copies[0].files, ElementsAre("a", "b"));
}

TEST(RadianceXform, AFileOfArgumentsGivesACopyALine) {
  const auto lines = [](const std::string& file) -> std::vector<std::string> {
    EXPECT_EQ(file, "places.txt");
    return {"# places", "", "!xform -t 1 0 0", "-t 2 0 0 -rz 90\r"};
  };
  const auto copies = parse_radiance_command("xform -n tree -f places.txt tree.rad", {"a.rad", 1}, lines).copies;
  ASSERT_EQ(copies.size(), 2U);
  expect_at(copies[0].transform({1.0, 0.0, 0.0}), 2.0, 0.0, 0.0);
  expect_at(copies[1].transform({1.0, 0.0, 0.0}), 0.0, 3.0, 0.0);
  EXPECT_EQ(copies[1].name, "tree.1");
}

TEST(RadianceXform, SkyMakersAreKnownAndNeverRun) {
  EXPECT_TRUE(parsed("gensky 12 21 12 -c | xform -rz 30").makes_sky);
  EXPECT_TRUE(parsed("/usr/local/radiance/bin/gendaylit 3 21 12 -W 800 100").makes_sky);
}

TEST(RadianceXform, AnyOtherCommandIsRefused) {
  for (const char* command : {"rm -rf x", "genbox a b 1 1 1", "sh -c 'xform a'", "cat a | sh", "", "xform a; ls",
                              "cat a > b", "cat `ls`", "cat $HOME/a", "xform a & ls"})
    EXPECT_THAT(refusal(command), HasSubstr("a.rad:7: ")) << command;
  EXPECT_THAT(refusal("genbox a b 1 1 1"), HasSubstr("no program is ever run from a scene"));
}

TEST(RadianceXform, WrongArgumentsAreRefused) {
  EXPECT_THAT(refusal("xform -t 1 2 a"), HasSubstr("'a' is no finite number"));
  EXPECT_THAT(refusal("xform -rz"), HasSubstr("a number is missing"));
  EXPECT_THAT(refusal("xform -s 0 a"), HasSubstr("-s 0 leaves nothing"));
  EXPECT_THAT(refusal("xform -q a"), HasSubstr("no option '-q'"));
  EXPECT_THAT(refusal("xform -t 1 2 3"), HasSubstr("names no file"));
  EXPECT_THAT(refusal("cat"), HasSubstr("names no file"));
  EXPECT_THAT(refusal("xform -a x a"), HasSubstr("'x' is no count"));
  EXPECT_THAT(refusal("xform -a 2000000 -t 1 0 0 a"), HasSubstr("more than 200000 copies"));
  EXPECT_THAT(refusal("xform -a 2000 -t 1 0 0 -a 2000 -t 0 1 0 a"), HasSubstr("more than 200000 copies"));
}

TEST(RadianceXform, ArraysTakeNoMoreMemoryThanTheirCopiesAreWorth) {
  std::string files;
  for (int i = 0; i < 1000; ++i) files += " a_rather_long_name_of_a_file.rad";
  EXPECT_THAT(refusal("xform -a 100 -t 1 0 0 -a 100 -t 0 1 0" + files), HasSubstr("too long for the copies"));
  EXPECT_THAT(refusal("xform -a 200000 -a 200000 -a 0 a"), HasSubstr("too long for the copies"));
  std::string arrays;
  for (int i = 0; i < 10000; ++i) arrays += " -a 1";
  EXPECT_THAT(refusal("xform" + arrays + " a"), HasSubstr("over 16 arrays"));
}

TEST(RadianceXform, AFileOfArgumentsThatNamesItselfIsRefused) {
  const auto lines = [](const std::string&) { return std::vector<std::string>{"-t 1 0 0 -f places.txt"}; };
  EXPECT_THROW(parse_radiance_command("xform -f places.txt a", {"a.rad", 1}, lines), InputError);
}

}  // namespace
}  // namespace clerestory::io
