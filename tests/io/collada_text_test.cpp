// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/collada_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/refusal.h"

namespace clerestory::io {
namespace {

using testing::HasSubstr;

TEST(ColladaText, UnitAndUpAxisAreTakenOutAndBytesKeepTheirPlaces) {
  const std::string before =
      "<COLLADA>\n<!-- <asset> -->\n<asset>\n<unit name='inch' meter = \"0.0254\"/>\n<up_axis> "
      "Z_UP\n</up_axis></asset>\n"
      "<x><asset><unit meter='7'/></asset></x></COLLADA>";
  std::string text = before;
  const ColladaAsset asset = take_asset(text, "a.dae");
  EXPECT_EQ(asset.metres_per_unit, 0.0254);
  EXPECT_EQ(asset.unit_line, 4U);
  EXPECT_EQ(asset.up, 'Z');
  EXPECT_EQ(text.size(), before.size());
  EXPECT_EQ(text.find("0.0254"), std::string::npos);
  EXPECT_EQ(text.find("Z_UP"), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), std::count(before.begin(), before.end(), '\n'));
  EXPECT_THAT(text, HasSubstr("<unit meter='7'/>"));
}

TEST(ColladaText, WithoutThemTheUnitIsUnknownAndYIsUp) {
  for (std::string text : {"<COLLADA><asset></asset></COLLADA>", "<COLLADA/>", "", "<asset", "<asset><unit",
                           "<asset><unit meter=\"1\"", "<asset><unit/><up_axis/></asset>", "<asset>>>\"</asset>"}) {
    const ColladaAsset asset = take_asset(text, "a.dae");
    EXPECT_FALSE(asset.metres_per_unit.has_value()) << text;
    EXPECT_EQ(asset.up, 'Y') << text;
  }
}

TEST(ColladaText, AUnitThatIsNoLengthIsRefusedWithItsLine) {
  for (const std::string bad : {"0", "-1", "nan", "inf", "", "1,5", "one"}) {
    std::string text = "<asset>\n<unit meter=\"" + bad + "\"/></asset>";
    EXPECT_EQ(test::refusal_of([&] { take_asset(text, "a.dae"); }),
              "a.dae:2: the unit of '" + bad + "' metres is no length; correct it, or remove it and set model.units");
  }
}

TEST(ColladaText, BlanksBeforeTextMoveBehindIt) {
  std::string text = "<a b='> 1'> \n 1 2<!-- > x --> 3</a>  <![CDATA[ > y]]>\t4<c>5 </c>";
  move_blanks_back(text);
  EXPECT_EQ(text, "<a b='> 1'>1 2 \n <!-- > x -->3 </a>  <![CDATA[ > y]]>4\t<c>5 </c>");
}

TEST(ColladaText, UnfinishedMarkupEndsWithTheText) {
  for (const std::string before : {"<", "<a", "<a b='", "<!--", "<a> 1", "  ", "<?xml", "<![CDATA[ "}) {
    std::string text = before;
    move_blanks_back(text);
    EXPECT_EQ(text.size(), before.size());
  }
}

TEST(ColladaText, AnElementIsFoundByItsWholeName) {
  EXPECT_EQ(line_of_element("<p>1</p>\n<phx/><!-- <ph> -->\n<ph><p>2</p></ph>", "ph"), 3U);
  EXPECT_FALSE(line_of_element("<p>1</p></ph>", "ph").has_value());
}

}  // namespace
}  // namespace clerestory::io
