// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc_step.h"

#include <gtest/gtest.h>

#include "tests/io/ifc_samples.h"

namespace clerestory::io {
namespace {

TEST(IfcStep, SchemaAndLinesOfEntitiesAreFound) {
  const auto outline = outline_step(test::ifc_text("#7=IFCWALL('a');\n#12 = IFCDOOR();\n", "ifc2x3"));
  EXPECT_EQ(outline.schema, "IFC2X3");
  EXPECT_EQ(outline.lines, (std::map<int, std::uint64_t>{{7, 8}, {12, 9}}));
  EXPECT_TRUE(outline.complete);
}

TEST(IfcStep, StringsAndCommentsHoldNoEntities) {
  const auto outline =
      outline_step(test::ifc_text("#1=IFCWALL('it''s; #2=x;\n#3=y');/* #4=IFCDOOR(); */\n#5=IFCDOOR();\n"));
  EXPECT_EQ(outline.lines, (std::map<int, std::uint64_t>{{1, 8}, {5, 10}}));
}

TEST(IfcStep, CutOffFileIsNotComplete) {
  const std::string text = test::ifc_text("#1=IFCWALL('a');\n#2=IFCDOOR('b');\n");
  const auto outline = outline_step(text.substr(0, text.find("'b'")));
  EXPECT_FALSE(outline.complete);
  EXPECT_EQ(outline.lines.size(), 1U);
}

TEST(IfcStep, AnyOtherTextIsNothing) {
  EXPECT_TRUE(outline_step("").lines.empty());
  EXPECT_TRUE(outline_step("#").lines.empty());
  EXPECT_TRUE(outline_step("#9999999999999=A();#=B();/*").lines.empty());
}

}  // namespace
}  // namespace clerestory::io
