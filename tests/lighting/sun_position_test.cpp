// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clerestory::lighting {
namespace {

constexpr double kSecond = 1.0 / 3600.0;  ///< [hours]
const Site kGolden{39.742476, -105.1786, -7.0};

double clock(int hours, int minutes, int seconds) { return hours + minutes / 60.0 + seconds / 3600.0; }

// Source: Reda, Andreas, Solar Position Algorithm for Solar Radiation Applications, NREL/TP-560-34302, 2008, table A5.1.
TEST(SunPosition, IsThatOfThePublishedExample) {
  const SunPosition sun = sun_position(kGolden, {2003, 10, 17, clock(12, 30, 30)}, {820.0, 11.0});
  EXPECT_NEAR(90.0 - sun.altitude_deg, 50.11162, 5e-4);
  EXPECT_NEAR(sun.azimuth_deg, 194.34024, 5e-4);
  EXPECT_NEAR(sun.altitude_deg - sun.true_altitude_deg, 0.01616, 5e-4);
}

TEST(SunPosition, RisesAndSetsWhenPublished) {
  const SunDay winter = sun_day(kGolden, 2015, 1, 2);
  EXPECT_NEAR(winter.rise_h.value(), clock(7, 21, 55), kSecond);
  EXPECT_NEAR(winter.transit_h, clock(12, 4, 45), kSecond);
  EXPECT_NEAR(winter.set_h.value(), clock(16, 47, 43), kSecond);
  const SunDay summer = sun_day(kGolden, 2015, 8, 2);
  EXPECT_NEAR(summer.rise_h.value(), clock(5, 0, 27), kSecond);
  EXPECT_NEAR(summer.transit_h, clock(12, 6, 58), kSecond);
  // The published set is that of the day by UTC, which is the evening before at this place.
  EXPECT_NEAR(sun_day(kGolden, 2015, 8, 1).set_h.value(), clock(19, 13, 58), kSecond);
}

TEST(SunPosition, NeverRisesInThePolarNightAndNeverSetsInThePolarDay) {
  const Site tromso{69.65, 18.96, 1.0};
  const SunDay winter = sun_day(tromso, 2026, 12, 21);
  EXPECT_FALSE(winter.rise_h.has_value());
  EXPECT_FALSE(winter.set_h.has_value());
  const SunDay summer = sun_day(tromso, 2026, 6, 21);
  EXPECT_FALSE(summer.rise_h.has_value());
  EXPECT_FALSE(summer.set_h.has_value());
  EXPECT_GT(sun_position(tromso, {2026, 6, 21, 0.0}).altitude_deg, 0.0);
}

TEST(SunPosition, RefractionLiftsTheHorizonByHalfADegree) {
  const Site site{50.0, 0.0, 0.0};
  const double set = sun_day(site, 2026, 3, 21).set_h.value();
  const SunPosition sun = sun_position(site, {2026, 3, 21, set}, {1010.0, 10.0});
  EXPECT_NEAR(sun.true_altitude_deg, -0.8333 - 0.0024, 1e-4);
  EXPECT_NEAR(sun.altitude_deg, -0.8333 + 0.63, 0.1);
}

TEST(SunPosition, DirectionsTurnWithNorth) {
  const auto expect = [](const mesh::Vector& found, const mesh::Vector& wanted) {
    EXPECT_LT(norm(found - wanted), 1e-12);
  };
  expect(direction_of(0.0, 0.0, 0.0), {0, 1, 0});
  expect(direction_of(0.0, 90.0, 0.0), {1, 0, 0});
  expect(direction_of(90.0, 17.0, 0.0), {0, 0, 1});
  expect(direction_of(0.0, 0.0, 90.0), {-1, 0, 0});
  expect(direction_of(0.0, 180.0, 90.0), {1, 0, 0});
}

TEST(SunPosition, DaysCountThroughLeapYears) {
  EXPECT_EQ(day_of_year({2023, 3, 1, 0.0}), 60);
  EXPECT_EQ(day_of_year({2024, 3, 1, 0.0}), 61);
  EXPECT_EQ(days_in_month(2000, 2), 29);
  EXPECT_EQ(days_in_month(1900, 2), 28);
}

}  // namespace
}  // namespace clerestory::lighting
