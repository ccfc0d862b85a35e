// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sun_position.h"

#include <libnova/dynamical_time.h>
#include <libnova/earth.h>
#include <libnova/julian_day.h>
#include <libnova/nutation.h>
#include <libnova/precession.h>
#include <libnova/sidereal_time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clerestory::lighting {

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kHorizon = -0.8333;  ///< centre of a rising or setting sun: refraction and half the disc [degrees]
constexpr double kParallax = 8.794 / 3600.0;  ///< of the sun at its mean distance [degrees]

constexpr double kAberration = 20.4898 / 3600.0;  ///< of the sun at its mean distance [degrees]
constexpr double kObliquityJ2000 = 23.4392911;    ///< of the ecliptic [degrees]

/// The same as seen from the place, not from the middle of the earth [degrees].
constexpr double kHorizonOfPlace = kHorizon - kParallax;

/// Where the sun stands without the air.
struct Geometric {
  double altitude_deg;
  double azimuth_deg;
  double hour_angle_deg;  ///< −180 … 180
};

double julian_day(const Site& site, const Moment& m) {
  ln_date noon{m.year, m.month, m.day, 12, 0, 0.0};
  return ln_get_julian_day(&noon) + (m.hour - 12.0 - site.timezone_h) / 24.0;
}

/// The sun's apparent place on the sky, equinox of the date [degrees].
struct Apparent {
  double right_ascension_deg;
  double declination_deg;
  double distance_au;
  double sidereal_deg;  ///< apparent, at Greenwich
};

/// libnova gives the earth's place by the equinox of J2000 and leaves cos ε out of the sidereal time's nutation: precession, nutation and
/// aberration are put on here [Meeus 1998, ch. 20, 22, 23].
Apparent apparent_sun(double day) {
  const double dynamical = ln_get_jde(day);
  ln_helio_posn earth{};
  ln_get_earth_helio_coords(dynamical, &earth);
  const double longitude = (earth.L + 180.0 - kAberration / earth.R) * kDegree;
  const double latitude = -earth.B * kDegree;
  const double tilt = kObliquityJ2000 * kDegree;
  ln_equ_posn of_j2000{};
  of_j2000.ra =
      std::atan2(std::sin(longitude) * std::cos(tilt) - std::tan(latitude) * std::sin(tilt), std::cos(longitude)) /
      kDegree;
  of_j2000.dec =
      std::asin(std::sin(latitude) * std::cos(tilt) + std::cos(latitude) * std::sin(tilt) * std::sin(longitude)) /
      kDegree;
  ln_equ_posn mean{};
  ln_get_equ_prec(&of_j2000, dynamical, &mean);
  ln_nutation nutation{};
  ln_get_nutation(dynamical, &nutation);
  const double obliquity = (nutation.ecliptic + nutation.obliquity) * kDegree;
  const double ra = mean.ra * kDegree;
  const double slant = std::tan(mean.dec * kDegree);
  return {mean.ra + (std::cos(obliquity) + std::sin(obliquity) * std::sin(ra) * slant) * nutation.longitude -
              std::cos(ra) * slant * nutation.obliquity,
          mean.dec + std::sin(obliquity) * std::cos(ra) * nutation.longitude + std::sin(ra) * nutation.obliquity,
          earth.R, 15.0 * ln_get_mean_sidereal_time(day) + nutation.longitude * std::cos(obliquity)};
}

Geometric geometric_position(const Site& site, double day) {
  const Apparent sun = apparent_sun(day);
  const double latitude = site.latitude_deg * kDegree;
  double hour = sun.sidereal_deg + site.longitude_deg - sun.right_ascension_deg;
  hour = (hour - 360.0 * std::round(hour / 360.0)) * kDegree;
  const double declination = sun.declination_deg * kDegree;
  const double south =
      std::cos(hour) * std::cos(declination) * std::sin(latitude) - std::sin(declination) * std::cos(latitude);
  const double west = std::sin(hour) * std::cos(declination);
  const double up =
      std::cos(hour) * std::cos(declination) * std::cos(latitude) + std::sin(declination) * std::sin(latitude);
  const double altitude = std::asin(std::clamp(up, -1.0, 1.0));
  const double parallax = kParallax / sun.distance_au * std::cos(altitude);
  double azimuth = std::atan2(west, south) / kDegree + 180.0;
  if (azimuth >= 360.0) azimuth -= 360.0;
  return {altitude / kDegree - parallax, azimuth, hour / kDegree};
}

/// What refraction adds to an altitude [degrees]; nothing to a sun that is wholly out of sight, a little lower than when it sets.
double refraction(double altitude_deg, const Air& air) {
  if (altitude_deg < kHorizonOfPlace - 1.0 / 3600.0) return 0.0;
  return air.pressure_mbar / 1010.0 * 283.0 / (273.0 + air.temperature_c) * 1.02 /
         (60.0 * std::tan((altitude_deg + 10.3 / (altitude_deg + 5.11)) * kDegree));
}

/// When the sun crosses the rising or setting altitude between two times of a day of which it is up in one [hours].
template <class AltitudeAt>
double crossing(double low, double high, const AltitudeAt& altitude) {
  const bool up_at_low = altitude(low) > kHorizonOfPlace;
  for (int i = 0; i < 32; ++i) {
    const double middle = 0.5 * (low + high);
    ((altitude(middle) > kHorizonOfPlace) == up_at_low ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

int days_in_month(int year, int month) {
  constexpr std::array<int, 12> kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return kDays.at(static_cast<std::size_t>(month - 1)) + (leap && month == 2 ? 1 : 0);
}

int day_of_year(const Moment& moment) {
  int day = moment.day;
  for (int month = 1; month < moment.month; ++month) day += days_in_month(moment.year, month);
  return day;
}

SunPosition sun_position(const Site& site, const Moment& moment, const Air& air) {
  const Geometric g = geometric_position(site, julian_day(site, moment));
  return {g.altitude_deg + refraction(g.altitude_deg, air), g.azimuth_deg, g.altitude_deg};
}

mesh::Vector direction_of(double altitude_deg, double azimuth_deg, double north_deg) {
  const double altitude = altitude_deg * kDegree;
  const double turned = (north_deg - azimuth_deg) * kDegree;  // from +y, counter-clockwise
  return {-std::sin(turned) * std::cos(altitude), std::cos(turned) * std::cos(altitude), std::sin(altitude)};
}

SunDay sun_day(const Site& site, int year, int month, int day) {
  const auto at = [&](double hour) { return geometric_position(site, julian_day(site, {year, month, day, hour})); };
  const auto altitude = [&](double hour) { return at(hour).altitude_deg; };
  SunDay result;
  // The hour angle grows by 15° an hour, so nearly that two steps are exact.
  for (int i = 0; i < 4; ++i) result.transit_h -= at(result.transit_h).hour_angle_deg / 15.0;
  if (altitude(result.transit_h) <= kHorizonOfPlace) return result;
  const double before = result.transit_h - 12.0;
  const double after = result.transit_h + 12.0;
  if (altitude(before) <= kHorizonOfPlace) result.rise_h = crossing(before, result.transit_h, altitude);
  if (altitude(after) <= kHorizonOfPlace) result.set_h = crossing(result.transit_h, after, altitude);
  return result;
}

}  // namespace clerestory::lighting
