// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text_table.h"

#include <gtest/gtest.h>

namespace clerestory::io {
namespace {

TEST(TextTable, ColumnsStandWhereTheirLetterSays) {
  EXPECT_EQ(text_table({{"part", "polygons"}, {"a wall", "7"}}), "part    polygons\na wall         7\n");
  EXPECT_EQ(text_table({{"a", "1", "left"}, {"bcd", "22", "l"}}, "lrl"), "a     1  left\nbcd  22  l\n");
}

TEST(TextTable, WidthsAreThoseOfCharactersAndNotOfBytes) {
  EXPECT_EQ(text_table({{"Küche", "1"}, {"Halle", "2"}}), "Küche  1\nHalle  2\n");
}

TEST(TextTable, FiguresHaveThreeSignificantDigits) {
  EXPECT_EQ(figure(0.0), "0");
  EXPECT_EQ(figure(1234.4), "1234");
  EXPECT_EQ(figure(12.34), "12.3");
  EXPECT_EQ(figure(0.123), "0.12");
  EXPECT_EQ(figure(-0.00123), "-0.0012");
}

}  // namespace
}  // namespace clerestory::io
