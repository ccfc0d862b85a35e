// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/epw.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/io/refusal.h"
#include "tests/support/places.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::HasSubstr;

/// A made-up year: which rows it has, and how they look.
struct MadeUp {
  bool leap = false;
  int an_hour = 1;
  std::size_t without = 1'000'000;  ///< the number of a row that is left out
  std::string direct = "100";
};

std::string header(int an_hour) {
  return fmt::format(
      "LOCATION,Somewhere,-,XXX,made up,0,48.1,11.6,1.0,500\nDESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\n"
      "GROUND TEMPERATURES,0\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,\nCOMMENTS 2,\n"
      "DATA PERIODS,1,{},Data,Sunday,1/1,12/31\n",
      an_hour);
}

std::string epw_of(const MadeUp& made) {
  std::string text = header(made.an_hour);
  std::size_t row = 0;
  for (int month = 1; month <= 12; ++month) {
    for (int day = 1; day <= lighting::days_in_month(made.leap ? 2000 : 2001, month); ++day) {
      for (int part = 0; part < 24 * made.an_hour; ++part, ++row) {
        if (row == made.without) continue;
        text += fmt::format("{},{},{},{},0,?,5.0,3.0,80,95000,0,0,300,200,{},50\n", 1990 + month, month, day,
                            part / made.an_hour + 1, made.direct);
      }
    }
  }
  return text;
}

std::string refusal(const std::string& name, const std::string& text) {
  const test::ScratchFolder folder;
  test::write_text(folder.path() / name, text);
  return test::refusal_of([&] { read_weather(folder.path() / name); });
}

lighting::Weather read(const std::string& name, const std::string& text) {
  const test::ScratchFolder folder;
  test::write_text(folder.path() / name, text);
  return read_weather(folder.path() / name);
}

TEST(Epw, RealFilesAreRead) {
  CLERESTORY_NEEDS_SHARED_DATA("weather-oakland");
  const auto oakland = read_weather(test::shared_data_dir() / "weather-oakland/USA_CA_Oakland.Intl.AP.724930_TMY3.epw");
  EXPECT_EQ(oakland.place, "Oakland Metropolitan Arpt");
  EXPECT_EQ(oakland.records.size(), 8760U);
  EXPECT_DOUBLE_EQ(oakland.site.longitude_deg, -122.22);
  EXPECT_DOUBLE_EQ(oakland.site.timezone_h, -8.0);
  EXPECT_DOUBLE_EQ(oakland.records[0].middle_h, 0.5);
  EXPECT_DOUBLE_EQ(oakland.records[0].pressure_mbar.value(), 1020.0);
  const auto turin = read_weather(test::shared_data_dir() / "weather-turin-pvgis/tmy_45.000_8.000_2005_2023.epw");
  EXPECT_EQ(turin.records.size(), 8760U);
  EXPECT_EQ(turin.records[0].direct_normal_w_m2.value(), 0.0);  // written as -0.00
}

// Summed from the same files by a script of 50 lines that shares nothing with the program: the sun by the low-precision formulas of
// Meeus as NOAA's calculator has them, half an hour before the time of each row; efficacies from the published table.
TEST(Epw, YearlySumsAreThoseOfAnIndependentSummation) {
  CLERESTORY_NEEDS_SHARED_DATA("weather-oakland");
  const auto oakland = lighting::sums_of(
      read_weather(test::shared_data_dir() / "weather-oakland/USA_CA_Oakland.Intl.AP.724930_TMY3.epw"));
  EXPECT_NEAR(oakland.global_klxh, 183'470.6, 0.0005 * 183'470.6);
  EXPECT_NEAR(oakland.diffuse_klxh, 83'145.6, 0.0005 * 83'145.6);
  EXPECT_DOUBLE_EQ(oakland.sunshine_h, 2925.0);
  EXPECT_NEAR(oakland.sun_up_h, 4448.0, 3.0);
  EXPECT_NEAR(oakland.direct_normal_kwh_m2, 1662.25, 0.01);
  const auto turin =
      lighting::sums_of(read_weather(test::shared_data_dir() / "weather-turin-pvgis/tmy_45.000_8.000_2005_2023.epw"));
  EXPECT_NEAR(turin.global_klxh, 155'230.2, 0.0005 * 155'230.2);
  EXPECT_NEAR(turin.diffuse_klxh, 72'803.8, 0.0005 * 72'803.8);
  EXPECT_DOUBLE_EQ(turin.sunshine_h, 2736.0);
  EXPECT_NEAR(turin.sun_up_h, 4434.0, 3.0);
}

TEST(Epw, HoursEndAtTheirTimeAndTheSunStandsInTheirMiddle) {
  EXPECT_DOUBLE_EQ(read("a.epw", epw_of({})).records.at(12).middle_h, 12.5);
  const auto fine = read("a.epw", epw_of({.an_hour = 4}));
  EXPECT_EQ(fine.records.size(), 35'040U);
  EXPECT_DOUBLE_EQ(fine.interval_h, 0.25);
  EXPECT_DOUBLE_EQ(fine.records.at(49).middle_h, 12.375);
}

TEST(Epw, LeapYearsAndMixedYearsAreRead) {
  const auto leap = read("a.epw", epw_of({.leap = true}));
  EXPECT_EQ(leap.records.size(), 8784U);
  EXPECT_EQ(leap.records.front().year, 1991);
  EXPECT_EQ(leap.records.back().year, 2002);
}

TEST(Epw, MissingValuesAreMissing) {
  const auto weather = read("a.epw", epw_of({.direct = "9999"}));
  // At night nothing tells the beam from the global irradiance; by day it is (200 - 50)/sin of the sun's altitude.
  EXPECT_FALSE(weather.records.at(0).direct_normal_w_m2.has_value());
  EXPECT_GT(weather.records.at(24 * 171 + 12).direct_normal_w_m2.value(), 150.0);
}

TEST(Epw, FilesAtFaultAreRefusedWithTheirLine) {
  EXPECT_THAT(refusal("a.epw", epw_of({.without = 100})),
              HasSubstr("a.epw:109: hour 6 of 1/5 stands where hour 5 of 1/5 is due"));
  EXPECT_THAT(refusal("a.epw", epw_of({.without = 8759})), HasSubstr("the file has 8759 rows of weather"));
  EXPECT_THAT(refusal("a.epw", epw_of({.direct = "noise"})),
              HasSubstr("a.epw:9: the direct normal irradiance is 'noise'"));
  EXPECT_THAT(refusal("a.epw", epw_of({.direct = "5000"})), HasSubstr("more than the sun gives"));
  const std::string whole = epw_of({});
  EXPECT_THAT(refusal("a.epw", whole.substr(0, 2000)), HasSubstr("the row has"));
  EXPECT_THAT(refusal("a.epw", whole.substr(0, 100)), HasSubstr("the file ends after"));
  EXPECT_THAT(refusal("a.epw", "no weather\n"), HasSubstr("an EPW begins with LOCATION"));
  EXPECT_THAT(refusal("a.epw", header(7)), HasSubstr("7 rows an hour do not divide it"));
  EXPECT_THAT(refusal("a.epw", header(1) + "20188,1,1,1,0,?,5,3,80,95000,0,0,300,200,100,50\n"),
              HasSubstr("the year is '20188'"));
  EXPECT_THAT(refusal("a.epw", header(1) + "2001,1,1,25,0,?,5,3,80,95000,0,0,300,200,100,50\n"),
              HasSubstr("the hour is '25'"));
  EXPECT_THAT(refusal("a.txt", whole), HasSubstr("is no weather"));
}

TEST(Epw, WeaIsReadWithItsSignsTurned) {
  const std::string text =
      "place Mountain View\nlatitude 37.42\nlongitude 122.05\ntime_zone 120\nsite_elevation 12.0\n"
      "weather_data_file_units 1\n3 21 11.5 627 236\n3 21 12.5 434 283\n";
  const auto weather = read("a.wea", text);
  EXPECT_DOUBLE_EQ(weather.site.longitude_deg, -122.05);
  EXPECT_DOUBLE_EQ(weather.site.timezone_h, -8.0);
  ASSERT_EQ(weather.records.size(), 2U);
  EXPECT_DOUBLE_EQ(weather.records[1].middle_h, 12.5);
  EXPECT_DOUBLE_EQ(weather.records[1].direct_normal_w_m2.value(), 434.0);
  EXPECT_THAT(refusal("a.wea", text + "3 21 9.5 1 1\n"), HasSubstr("a.wea:9: the row is not later"));
  EXPECT_THAT(refusal("a.wea", text + "3 21 13.5\n"), HasSubstr("the row has 3 of 5 numbers"));
  EXPECT_THAT(
      refusal("a.wea", "place x\nlatitude 1\nlongitude 2\ntime_zone 0\nsite_elevation 0\nweather_data_file_units 2\n"),
      HasSubstr("1 (irradiances) is what is read"));
}

}  // namespace
}  // namespace clerestory::io
