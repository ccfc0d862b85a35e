// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/weather_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace clerestory::io {
namespace {

using testing::HasSubstr;

/// A day in June at noon of which one hour is bright.
lighting::Weather bright_noon() {
  lighting::Weather weather;
  weather.place = "Somewhere";
  weather.site = {48.0, 11.0, 1.0};
  for (int hour = 0; hour < 24; ++hour) {
    lighting::WeatherRecord r;
    r.year = 2001;
    r.month = 6;
    r.day = 21;
    r.middle_h = hour + 0.5;
    r.direct_normal_w_m2 = hour == 12 ? 800.0 : 0.0;
    r.diffuse_horizontal_w_m2 = hour == 12 ? 100.0 : 0.0;
    weather.records.push_back(r);
  }
  return weather;
}

TEST(WeatherReport, TellsPlaceRecordsAndSums) {
  const std::string text = weather_text(bright_noon(), "a.epw");
  EXPECT_THAT(text, HasSubstr("a.epw: weather of Somewhere"));
  EXPECT_THAT(text, HasSubstr("24 records of 1 h, years 2001; 0 without irradiance"));
  const auto json = nlohmann::json::parse(weather_json(bright_noon(), "a.epw", "1"));
  EXPECT_EQ(json.at("sunshine_h"), 1.0);
  EXPECT_NEAR(json.at("direct_normal_kwh_m2").get<double>(), 0.8, 1e-12);
}

TEST(WeatherReport, ThePictureHasAColumnADayAndNoonInTheMiddle) {
  const Raster picture = weather_picture(bright_noon());
  const int x = 60 + 3 * 171 + 1;  // the 21st of June is day 171, from 0
  const auto colour_at = [&](double hour) { return picture.at(x, static_cast<int>(60 + 16 * (24.0 - hour))); };
  EXPECT_EQ(colour_at(3.5), (Rgb{225, 225, 230}));
  EXPECT_FALSE(colour_at(12.5) == (Rgb{225, 225, 230}));
  EXPECT_EQ(picture.at(x + 9, 200), (Rgb{255, 255, 255}));
}

}  // namespace
}  // namespace clerestory::io
