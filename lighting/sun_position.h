// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "mesh/geometry.h"

namespace clerestory::lighting {

/// A place on the earth, and its clock.
struct Site {
  double latitude_deg = 0.0;   ///< north positive
  double longitude_deg = 0.0;  ///< east positive
  double timezone_h = 0.0;     ///< east of UTC positive
};

/// The air that bends the sun's light.
struct Air {
  double pressure_mbar = 1013.25;
  double temperature_c = 15.0;
};

/// A moment in local standard time, Gregorian calendar.
struct Moment {
  int year = 2026;
  int month = 3;
  int day = 21;
  double hour = 12.0;  ///< 0 … 24
};

/// Days in a month.
int days_in_month(int year, int month);

/// From 1.
int day_of_year(const Moment& moment);

/// Where the sun stands in the sky, its centre.
struct SunPosition {
  double altitude_deg = 0.0;  ///< apparent: with refraction
  double azimuth_deg = 0.0;   ///< from north to east, 0 … 360

  /// The same of the altitude without refraction.
  double true_altitude_deg = 0.0;
};

/// The sun as seen from a place: VSOP87 with nutation and aberration, parallax, refraction by pressure and temperature [Reda, Andreas 2004,
/// eq. 42] where the sun is not wholly under the horizon. Good to 0.001° from 1900 to 2100, but for what the air does near the horizon.
SunPosition sun_position(const Site& site, const Moment& moment, const Air& air = {});

/// The unit vector towards an altitude and azimuth [degrees], in a model whose north is so many degrees counter-clockwise from +y.
mesh::Vector direction_of(double altitude_deg, double azimuth_deg, double north_deg);

/// Local standard times of a day [hours]; they may lie a little outside of 0 … 24. Rise and set: the upper limb on the horizon, the centre
/// 0.8333° below it as seen from the middle of the earth [Reda, Andreas 2004, A.2]. None where the sun stays up or down.
struct SunDay {
  std::optional<double> rise_h;
  double transit_h = 12.0;
  std::optional<double> set_h;
};
SunDay sun_day(const Site& site, int year, int month, int day);

}  // namespace clerestory::lighting
