// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/places.h"

namespace clerestory::io {
namespace {

using testing::Contains;
using testing::HasSubstr;
using Json = nlohmann::json;

class ModelReportTest : public testing::Test {
 protected:
  StudyInput input_ =
      read_study(test::source_dir() / "tests" / "cli" / "inputs" / "room.obj", {.set = {}, .model_only = true});
  NoProgress progress_;
  ModelReport report_ = look_at(input_, "room.obj", "9.9", progress_);
  Json json_ = Json::parse(report_json_text(report_));
};

TEST_F(ModelReportTest, SharesTheWordsOfTheSummary) {
  EXPECT_THAT(json_["parts"], Contains("walls"));
  ASSERT_EQ(json_["materials"].size(), 4U);
  EXPECT_EQ(json_["materials"][3]["name"], "glass");
  EXPECT_EQ(json_["materials"][3]["became"], "glazing 0.70");
  EXPECT_EQ(json_["materials"][3]["why"], "named like glass");
  ASSERT_EQ(json_["rooms"].size(), 1U);
  EXPECT_EQ(json_["rooms"][0]["closed"], true);
  EXPECT_NEAR(json_["rooms"][0]["floor_area_m2"].get<double>(), 12.0, 0.3);
  EXPECT_TRUE(json_["defects"].is_object());
  EXPECT_TRUE(json_["assumptions"].is_array());
}

TEST_F(ModelReportTest, TellsFormatUnitAndSize) {
  EXPECT_EQ(json_["program"], "clerestory");
  EXPECT_EQ(json_["format"], "OBJ");
  EXPECT_EQ(json_["unit"], "m");
  EXPECT_THAT(json_["unit_source"].get<std::string>(), HasSubstr("line 1"));
  EXPECT_EQ(json_["up"], "z");
  EXPECT_EQ(json_["high"], Json({4.0, 3.0, 2.7}));
  EXPECT_EQ(json_["openings"]["count"], 1);
  EXPECT_NEAR(json_["openings"]["area_m2"].get<double>(), 2.4, 1e-9);
}

TEST_F(ModelReportTest, TheTextHasATableOfEach) {
  const std::string text = report_text(report_);
  EXPECT_THAT(text, HasSubstr("room.obj: OBJ\n"));
  EXPECT_THAT(text, HasSubstr("size      4.00 x 3.00 x 2.70 m"));
  EXPECT_THAT(text, HasSubstr("pillar          6\n"));
  EXPECT_THAT(text, HasSubstr("glazing 0.70"));
  EXPECT_THAT(text, HasSubstr("openings to brighter places  1, 2.40 m²"));
  EXPECT_THAT(text, HasSubstr("assumed: "));
}

TEST_F(ModelReportTest, DefectsHaveTheirWorstPlacesAndWhatToDo) {
  mesh::Defect gaps{.kind = "gaps", .found = 5, .mended = 4, .places = {}};
  gaps.places.push_back({.polygon = 2, .at = {1, 2, 0.5}, .note = "too wide", .size_m = 0.004, .mended = false});
  report_.clean.defects = {gaps};
  const Json defect = Json::parse(report_json_text(report_))["defects"]["gaps"];
  EXPECT_EQ(defect["found"], 5);
  EXPECT_EQ(defect["mended"], 4);
  EXPECT_THAT(defect["to_do"].get<std::string>(), HasSubstr("--gap"));
  EXPECT_EQ(defect["worst"][0]["part"], "walls");
  EXPECT_EQ(defect["worst"][0]["line"], 34);
  EXPECT_EQ(defect["worst"][0]["at"], Json({1.0, 2.0, 0.5}));
  EXPECT_THAT(report_text(report_),
              HasSubstr("gaps: 5 found, 4 mended\n"
                        "  1 left: too wide\n"
                        "  at (1.000, 2.000, 0.500), part 'walls', line 34: 4 mm, left: too wide\n"
                        "  to do: "));
}

}  // namespace
}  // namespace clerestory::io
