// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/words.h"

#include <gtest/gtest.h>

namespace clerestory::io {
namespace {

using Names = std::vector<std::string>;

TEST(Words, NumbersAreTheNearestDoubleAndTakeUpTheWholeText) {
  EXPECT_EQ(parse_number("612345.123456"), 612345.123456);
  EXPECT_EQ(parse_number("+1e-2"), 0.01);
  EXPECT_EQ(parse_number("1e-999"), 0.0);
  for (const char* bad : {"", "+", "1x", "nan", "inf", "1e999", "0x1p3", " 1", "1 ", "+-1"})
    EXPECT_FALSE(parse_number(bad)) << bad;
}

TEST(Words, SharesMayBeInPerCent) {
  EXPECT_DOUBLE_EQ(*parse_share("2%"), 0.02);
  EXPECT_DOUBLE_EQ(*parse_share(" 0.5 %"), 0.005);
  EXPECT_DOUBLE_EQ(*parse_share("0.02"), 0.02);
  EXPECT_FALSE(parse_share("%"));
  EXPECT_FALSE(parse_share("two"));
}

TEST(Words, EditDistanceCountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("reflectance", "refelctance"), 1U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("same", "same"), 0U);
}

TEST(Words, TheNearestNameIsFoundOrNone) {
  const Names names{"floor", "ceiling", "wall", "Glazing"};
  EXPECT_EQ(nearest("flor", names), "floor");
  EXPECT_EQ(nearest("glazing", names), "Glazing");
  EXPECT_EQ(nearest("wall_01", names), "wall");
  EXPECT_FALSE(nearest("chair", names).has_value());
  EXPECT_FALSE(nearest("xy", Names{"ab"}).has_value());
}

TEST(Words, GlobsMatchAsInAShell) {
  EXPECT_TRUE(matches_glob("glass*", "glass 4mm"));
  EXPECT_TRUE(matches_glob("w?ll[0-9]", "wall3"));
  EXPECT_FALSE(matches_glob("glass*", "Glass"));
  EXPECT_TRUE(is_glob("a*"));
  EXPECT_FALSE(is_glob("a.b"));
}

TEST(Words, ListsAreCutAndSaySo) {
  EXPECT_EQ(list_names(Names{"a", "b", "c"}, 2), "a, b, c");
  EXPECT_EQ(list_names(Names{"a", "b", "c", "d"}, 2), "a, b and 2 more");
  EXPECT_EQ(list_names(Names{}), "");
}

TEST(Words, SplitAtBlanks) {
  EXPECT_EQ(split_words("  a\t b  "), (std::vector<std::string_view>{"a", "b"}));
  EXPECT_TRUE(split_words(" \t").empty());
  EXPECT_EQ(trim("  a b\r"), "a b");
}

}  // namespace
}  // namespace clerestory::io
