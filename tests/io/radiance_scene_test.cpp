// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/refusal.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using test::refusal_of;
using testing::ElementsAre;
using testing::HasSubstr;

class RadianceScene : public testing::Test {
 protected:
  std::vector<RadianceStatement> read(const std::string& text) {
    test::write_text(folder_.path() / "a.rad", text);
    notices_ = {};
    return read_radiance_file(folder_.path() / "a.rad", notices_).statements;
  }
  std::string refusal(const std::string& text) {
    return refusal_of([&] { read(text); });
  }
  std::vector<std::string> notices() const { return notices_.sentences(); }

 private:
  test::ScratchFolder folder_;
  RadianceNotices notices_;
};

TEST_F(RadianceScene, PrimitivesCommandsAndAliasesAreStatements) {
  const auto read_ones = read(
      "void plastic wall 0 0 5 .5 .5 .5 0 0\n!cat b.rad\nvoid alias paint wall\n"
      "wall ring lid 0 0 8 0 0 1 0 0 1 0 .5\n");
  ASSERT_EQ(read_ones.size(), 4U);
  EXPECT_EQ(read_ones[0].primitive.type, "plastic");
  EXPECT_THAT(read_ones[0].primitive.reals, ElementsAre(0.5, 0.5, 0.5, 0.0, 0.0));
  EXPECT_EQ(read_ones[1].command, "cat b.rad");
  EXPECT_THAT(read_ones[2].primitive.strings, ElementsAre("wall"));
  EXPECT_EQ(read_ones[3].primitive.kind, RadianceKind::kSurface);
  EXPECT_EQ(read_ones[3].line, 4U);
}

TEST_F(RadianceScene, AWrongCountOfNumbersIsSurvivedAndNoticed) {
  const auto primitives = read(
      "m polygon one 0 0\n8.0\n0 0 0 1 0 0 1 1 0\n"
      "m polygon two 0 0 12 0 0 0 1 0 0 1 1 0\n"
      "m polygon three 0 0 3 0 0 0 1 0 0 1 1 0\n# end\n");
  ASSERT_EQ(primitives.size(), 3U);
  for (const RadianceStatement& statement : primitives) EXPECT_EQ(statement.primitive.reals.size(), 9U);
  ASSERT_EQ(notices().size(), 1U);
  EXPECT_THAT(notices()[0], HasSubstr("wrong count of numbers, taken with those that stand there: 3"));
  EXPECT_THAT(notices()[0], HasSubstr("the first is 'one' in "));
  EXPECT_THAT(notices()[0], HasSubstr("a.rad:2."));
}

TEST_F(RadianceScene, ANumberMayBeAModifier) {
  const auto primitives = read("void plastic 1 0 0 5 .5 .5 .5 0 0 1 sphere ball 0 0 4 0 0 0 1");
  ASSERT_EQ(primitives.size(), 2U);
  EXPECT_EQ(primitives[1].primitive.modifier, "1");
}

TEST_F(RadianceScene, FilesThatAreCutOffAreRefused) {
  EXPECT_THAT(refusal("m polygon a 0 0 9 0 0 0\n1 0"), HasSubstr("a.rad:2: the file ends inside 'a'"));
  EXPECT_THAT(refusal("m"), HasSubstr("the file ends inside a primitive"));
  EXPECT_THAT(refusal("m polygon a 0 0"), HasSubstr("the file ends inside 'a'"));
  EXPECT_THAT(refusal("m polygon a 99999999 x y"), HasSubstr("the file ends inside 'a'"));
  EXPECT_THAT(refusal("m polygon a 0 0\n!cat b"), HasSubstr("a.rad:2: a command stands inside 'a'"));
}

TEST_F(RadianceScene, WhatIsNoNumberIsRefusedWithItsLine) {
  for (const char* bad : {"nan", "inf", "1e999", "x", "0x10"})
    EXPECT_THAT(refusal("m polygon a 0 0 9 0 0 0\n1 " + std::string(bad) + " 0 1 1 0\n"),
                HasSubstr("a.rad:2: '" + std::string(bad) + "' is no finite number"))
        << bad;
  EXPECT_THAT(refusal("m polygon a x 0 9"), HasSubstr("'x' is no count of the words"));
  EXPECT_THAT(refusal("m polygon a 0 -1 9"), HasSubstr("'-1' is no count of the integers"));
  EXPECT_THAT(refusal("m polygon a 0 0 x"), HasSubstr("'x' is no count of the numbers"));
}

TEST_F(RadianceScene, UnknownTypesAreRefused) {
  EXPECT_THAT(refusal("wall poligon a 0 0 0"), HasSubstr("a.rad:1: 'poligon' is no type of a Radiance primitive"));
}

TEST(LooksLikeRadiance, ACommandOrAPrimitiveWithItsCountsDecides) {
  EXPECT_TRUE(looks_like_radiance("# made by hand\n\n!xform -t 0 0 1 a.rad\n"));
  EXPECT_TRUE(looks_like_radiance("wall polygon\na\n0\n0\n9"));
  EXPECT_TRUE(looks_like_radiance("void alias a b\n"));
  EXPECT_FALSE(looks_like_radiance("solid cone\nfacet normal 0 0 1\n"));
  EXPECT_FALSE(looks_like_radiance("v 0 0 0\nv 1 0 0\n"));
  EXPECT_FALSE(looks_like_radiance(""));
}

}  // namespace
}  // namespace clerestory::io
