// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "lighting/sun_position.h"
#include "tests/io/refusal.h"
#include "tests/io/study_folder.h"
#include "tests/support/places.h"

namespace clerestory::io {
namespace {

using test::StudyFolder;
using testing::Contains;
using testing::HasSubstr;

constexpr const char* kModel = "[model]\nfile = 'room.obj'\n";
constexpr const char* kBeam = "sun = true\nsun_normal_illuminance = 80000\n";
constexpr const char* kMunich = "[site]\nlatitude = 48.1\nlongitude = 11.6\ntimezone = 1.0\n";

lighting::Study read(const std::string& lines) { return StudyFolder().read(kModel + lines).study; }
std::string refusal(const std::string& lines) {
  return test::refusal_of([&] { read(lines); });
}

TEST(StudySun, ATimeAndAPlaceTellWhereTheSunStands) {
  const auto study = read(std::string(kMunich) + "[sky]\ntime = 2026-03-21T12:00:00\n" + kBeam);
  const auto sun = lighting::sun_position({48.1, 11.6, 1.0}, {2026, 3, 21, 12.0});
  EXPECT_LT(norm(study.sky.sun.towards - lighting::direction_of(sun.altitude_deg, sun.azimuth_deg, 0.0)), 1e-12);
  EXPECT_THAT(study.assumptions, Contains(HasSubstr("the sun stands at altitude")));
}

TEST(StudySun, AnOffsetOfTheTimeCountsBeforeTheTimezone) {
  const auto local = read(std::string(kMunich) + "[sky]\ntime = 2026-03-21T12:00:00\n" + kBeam);
  const auto utc = read(std::string(kMunich) + "[sky]\ntime = 2026-03-21T11:00:00Z\n" + kBeam);
  const auto far = read(std::string(kMunich) + "[sky]\ntime = 2026-03-21T06:00:00-05:00\n" + kBeam);
  EXPECT_LT(norm(local.sky.sun.towards - utc.sky.sun.towards), 1e-9);
  EXPECT_LT(norm(local.sky.sun.towards - far.sky.sun.towards), 1e-9);
}

TEST(StudySun, NorthTurnsTheSun) {
  const auto turned =
      StudyFolder()
          .read("[model]\nfile = 'room.obj'\nnorth = 90.0\n[sky]\nsun_altitude = 0.1\nsun_azimuth = 0.0\n" +
                std::string(kBeam))
          .study;
  EXPECT_NEAR(turned.sky.sun.towards.x, -1.0, 1e-5);
}

TEST(StudySun, AMomentWithoutPlaceOrZoneIsRefused) {
  EXPECT_THAT(refusal("[sky]\ntime = 2026-03-21T12:00:00\n"), HasSubstr("study.toml:4: sky.time needs site.latitude"));
  EXPECT_THAT(refusal("[site]\nlatitude = 48.0\nlongitude = 11.0\n[sky]\ntime = 2026-03-21T12:00:00\n"),
              HasSubstr("sky.time needs site.timezone; write timezone = 1.0"));
  EXPECT_THAT(refusal(std::string(kMunich) + "[sky]\ntime = 2026-03-21\n"), HasSubstr("expected a day and a time"));
  EXPECT_THAT(refusal(std::string(kMunich) + "[sky]\ntime = 2026-03-21T12:00:00\nsun_altitude = 3.0\n"),
              HasSubstr("give one of them"));
  EXPECT_THAT(refusal("[sky]\nsun_altitude = 3.0\n"), HasSubstr("needs both"));
  EXPECT_THAT(refusal("[sky]\ntype = 'weather'\n"), HasSubstr("needs sky.time"));
  EXPECT_THAT(refusal(std::string(kMunich) + "[sky]\ntype = 'weather'\ntime = 2026-03-21T12:00:00\n"),
              HasSubstr("needs site.weather"));
}

TEST(StudySun, TheWeatherTellsPlaceZoneAndIrradiance) {
  CLERESTORY_NEEDS_SHARED_DATA("weather-oakland");
  const std::string file =
      (test::shared_data_dir() / "weather-oakland/USA_CA_Oakland.Intl.AP.724930_TMY3.epw").string();
  const auto study =
      read("[site]\nweather = '" + file + "'\n[sky]\ntype = 'weather'\nsun = true\ntime = 2026-06-21T12:00:00\n");
  EXPECT_TRUE(study.sky.sun.shines());
  const auto sun = lighting::sun_position({37.72, -122.22, -8.0}, {2026, 6, 21, 12.0});
  EXPECT_NEAR(std::asin(study.sky.sun.towards.z) * 57.29577951, sun.altitude_deg, 1e-3);
  EXPECT_THAT(study.assumptions, Contains(HasSubstr("The building stands where the weather was measured: Oakland")));
}

TEST(StudySun, AListOfMomentsGivesTheSkyOfEach) {
  const auto study = read(std::string(kMunich) +
                          "[sky]\ntime = [2026-03-21T09:00:00, 2026-03-21T12:00:30, 2026-03-21T09:00:00, "
                          "2026-03-21T23:00:00+01:00]\n" +
                          kBeam);
  ASSERT_EQ(study.moments.size(), 3U);
  EXPECT_EQ(study.moments[0].moment, "2026-03-21T0900");
  EXPECT_EQ(study.moments[1].moment, "2026-03-21T120030");
  EXPECT_EQ(study.moments[2].moment, "2026-03-21T2300+0100");
  EXPECT_EQ(study.sky.type, lighting::Sky::Type::kSum);
  EXPECT_LT(study.moments[0].sun.towards.z, study.moments[1].sun.towards.z);
  EXPECT_EQ(study.moments[2].type, lighting::Sky::Type::kNone);
  EXPECT_THAT(study.assumptions, testing::Contains(HasSubstr("2026-03-21T09:00:00 is given twice")));
  EXPECT_THAT(study.assumptions, testing::Contains(HasSubstr("the sky is dark, and lamps alone give light")));
}

TEST(StudySun, AListOfOneMomentIsThatMoment) {
  const auto one = read(std::string(kMunich) + "[sky]\ntime = [2026-03-21T12:00:00]\n" + kBeam);
  EXPECT_TRUE(one.moments.empty());
  EXPECT_GT(one.sky.sun.towards.z, 0.6);
  EXPECT_THAT(refusal(std::string(kMunich) + "[sky]\ntime = ['noon']\n"),
              HasSubstr("a date and time, or a list of them"));
}

}  // namespace
}  // namespace clerestory::io
