// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/weather.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clerestory::lighting {
namespace {

/// Two days in June, the beam of each hour ten times the number of the hour, some diffuse light.
Weather two_days() {
  Weather weather;
  weather.site = {48.0, 11.0, 1.0};
  for (int day = 20; day <= 21; ++day) {
    for (int hour = 0; hour < 24; ++hour) {
      WeatherRecord r;
      r.year = 2001;
      r.month = 6;
      r.day = day;
      r.middle_h = hour + 0.5;
      r.direct_normal_w_m2 = 10.0 * (hour + 0.5);
      r.diffuse_horizontal_w_m2 = 100.0;
      weather.records.push_back(r);
    }
  }
  return weather;
}

TEST(Weather, BetweenTheMiddlesOfHoursIrradianceLiesOnTheirLine) {
  const Weather weather = two_days();
  EXPECT_NEAR(irradiance_at(weather, {2026, 6, 21, 12.0}).value().direct_normal_w_m2, 120.0, 1e-9);
  EXPECT_NEAR(irradiance_at(weather, {2026, 6, 21, 12.5}).value().direct_normal_w_m2, 125.0, 1e-9);
  EXPECT_NEAR(irradiance_at(weather, {2026, 6, 20, 24.0}).value().direct_normal_w_m2, 120.0, 1e-9);
  EXPECT_EQ(irradiance_at(weather, {2026, 6, 21, 12.0}).value().day_of_year, 172);
}

TEST(Weather, WhereThereIsNoRecordThereIsNoIrradiance) {
  Weather weather = two_days();
  EXPECT_FALSE(irradiance_at(weather, {2026, 7, 21, 12.0}).has_value());
  weather.records[36].direct_normal_w_m2.reset();
  EXPECT_FALSE(irradiance_at(weather, {2026, 6, 21, 12.5}).has_value() &&
               irradiance_at(weather, {2026, 6, 21, 12.5}).value().direct_normal_w_m2 == 125.0);
}

TEST(Weather, SumsCountEveryRecordByItsInterval) {
  const Weather weather = two_days();
  const WeatherSums sums = sums_of(weather);
  EXPECT_NEAR(sums.direct_normal_kwh_m2, 2.0 * 10.0 * 288.0 / 1000.0, 1e-9);
  EXPECT_NEAR(sums.diffuse_horizontal_kwh_m2, 4.8, 1e-9);
  EXPECT_DOUBLE_EQ(sums.sunshine_h, 24.0);
  EXPECT_DOUBLE_EQ(sums.sun_up_h, 32.0);
  EXPECT_GT(sums.global_klxh, sums.diffuse_klxh);
  EXPECT_EQ(sums.missing, 0U);
  EXPECT_EQ(sums.dark_h, 0.0);
  Weather hole = weather;
  hole.records[12].direct_normal_w_m2 = 0.0;
  hole.records[12].diffuse_horizontal_w_m2 = 0.0;
  EXPECT_EQ(sums_of(hole).dark_h, 1.0);
}

TEST(Weather, ALeapDayThatTheYearLacksIsTheDayBefore) {
  Weather weather = two_days();
  for (WeatherRecord& r : weather.records) {
    r.month = 2;
    r.day += 7;
  }
  EXPECT_NEAR(irradiance_at(weather, {2028, 2, 29, 12.5}).value().direct_normal_w_m2, 125.0, 1e-9);
}

}  // namespace
}  // namespace clerestory::lighting
