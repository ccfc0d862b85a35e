// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/units.h"

#include <gtest/gtest.h>

namespace clerestory::io {
namespace {

TEST(Units, AreNamedByTheWordsOfTheStudy) {
  EXPECT_EQ(metres_per(*length_unit("m")), 1.0);
  EXPECT_EQ(metres_per(*length_unit("cm")), 0.01);
  EXPECT_EQ(metres_per(*length_unit("mm")), 0.001);
  EXPECT_EQ(metres_per(*length_unit("in")), 0.0254);
  EXPECT_EQ(metres_per(*length_unit("ft")), 0.3048);
  EXPECT_FALSE(length_unit("yd").has_value());
  EXPECT_EQ(unit_word(LengthUnit::kFoot), "ft");
}

TEST(Units, CommentsOfExportersNameThem) {
  EXPECT_EQ(unit_in_comment("# File units = meters"), LengthUnit::kMetre);
  EXPECT_EQ(unit_in_comment("# office: z up, metres; every quad as 2 triangles"), LengthUnit::kMetre);
  EXPECT_EQ(unit_in_comment("# Units: mm"), LengthUnit::kMillimetre);
  EXPECT_EQ(unit_in_comment("# This file uses centimeters as units"), LengthUnit::kCentimetre);
  EXPECT_EQ(unit_in_comment("# File units = Inches"), LengthUnit::kInch);
  EXPECT_EQ(unit_in_comment("# units: feet"), LengthUnit::kFoot);
}

TEST(Units, CommentsThatOnlyMentionShortWordsNameNone) {
  EXPECT_FALSE(unit_in_comment("# made in Munich by m").has_value());
  EXPECT_FALSE(unit_in_comment("# was inches, now metres").has_value());
  EXPECT_FALSE(unit_in_comment("#").has_value());
}

TEST(Units, AreGuessedFromTheHeight) {
  EXPECT_EQ(guess_unit(2.7), LengthUnit::kMetre);
  EXPECT_EQ(guess_unit(99.0), LengthUnit::kMetre);
  EXPECT_EQ(guess_unit(270.0), LengthUnit::kCentimetre);
  EXPECT_EQ(guess_unit(2700.0), LengthUnit::kMillimetre);
  EXPECT_EQ(guess_unit(0.0), LengthUnit::kMetre);
}

}  // namespace
}  // namespace clerestory::io
