// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/photometry_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

namespace clerestory::io {
namespace {

using lighting::Photometry;
using testing::HasSubstr;

/// 100 cd below the horizon.
Photometry lamp() {
  Photometry p;
  p.format = "EULUMDAT";
  p.name = "Lamp";
  p.symmetry = Photometry::Symmetry::kAboutAxis;
  p.vertical_deg = {0, 90};
  p.horizontal_deg = {0};
  p.candela = {100, 100};
  p.opening = {.shape = lighting::LuminousOpening::Shape::kRectangle, .x_m = 0.3, .y_m = 1.2};
  p.lamps.emplace_back().flux_lm = 800;
  p.stated_flux_lm = 630.0;
  p.power_w = 10.0;
  p.notes = {"A note."};
  return p;
}

TEST(PhotometryReport, SaysWhatIsInTheFile) {
  const std::string text = photometry_text(lamp(), "lamp.ldt");
  for (const char* line :
       {"lamp.ldt: EULUMDAT\n", "photometry  type C, relative, symmetry about the axis\n",
        "opening     rectangle, 0.300 m along C0, 1.200 m along C90, 0.000 m high\n",
        "flux        628.3 lm by integration, 630.0 lm stated (-0.27 %)\n", "downwards   100.0 % of it\n",
        "output      78.5 % of the lamps' flux\n", "power       10 W, 62.8 lm/W\n", "peak        100.0 cd\n",
        "note        A note.\n", "UGR by CIE 190", "2H x 2H", "12H x 8H"})
    EXPECT_THAT(text, HasSubstr(line));
}

TEST(PhotometryReport, APointHasNoUgr) {
  Photometry point = lamp();
  point.opening = {};
  EXPECT_THAT(photometry_text(point, "lamp.ldt"), testing::Not(HasSubstr("UGR")));
}

TEST(PhotometryReport, JsonHasTheSameAndTheIntensities) {
  const auto json = nlohmann::json::parse(photometry_json(lamp(), "lamp.ldt", "1.0"));
  EXPECT_NEAR(json["flux_lm"].get<double>(), 200.0 * std::numbers::pi, 1e-9);
  EXPECT_EQ(json["flux_stated_lm"], 630.0);
  EXPECT_EQ(json["intensities"]["planes"].size(), 24U);
  EXPECT_EQ(json["intensities"]["planes"][3]["candela"][18], 100.0);  // γ = 90
  EXPECT_EQ(json["intensities"]["planes"][3]["candela"][19], 0.0);
  EXPECT_EQ(json["ugr_table"].size(), 19U);
  EXPECT_EQ(json["ugr_table"][0]["ugr"].size(), 10U);
}

}  // namespace
}  // namespace clerestory::io
