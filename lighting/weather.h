// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lighting/perez.h"
#include "lighting/sun_position.h"

namespace clerestory::lighting {

/// The mean weather of an interval.
struct WeatherRecord {
  int year = 0;  ///< from which it was taken: records of a typical year come from several
  int month = 1;
  int day = 1;
  double middle_h = 0.0;  ///< of the interval, local standard time: the sun stands as at that time
  std::optional<double> direct_normal_w_m2;
  std::optional<double> diffuse_horizontal_w_m2;
  std::optional<double> dew_point_c;
  std::optional<double> temperature_c;
  std::optional<double> pressure_mbar;
};

/// A weather file: records in the order of the year.
struct Weather {
  std::string place;
  Site site;
  double elevation_m = 0.0;
  double interval_h = 1.0;
  std::vector<WeatherRecord> records;
};

/// Where the sun stands in the middle of a record's interval.
SunPosition sun_of(const Weather& weather, const WeatherRecord& record);

/// What a record gives; missing irradiances count as none, a missing dew point as 11 °C.
Irradiance irradiance_of(const WeatherRecord& record);

/// Irradiances at a moment, the year left aside: on the line between the middles of the intervals before and after it. None where the
/// weather has no record within an interval of the moment, or no irradiance there.
std::optional<Irradiance> irradiance_at(const Weather& weather, const Moment& moment);

/// Pressure and temperature of the record nearest to a moment, or the standard's.
Air air_at(const Weather& weather, const Moment& moment);

/// What a record gives the horizontal ground outdoors, by the sun in the middle of its interval [lux].
struct OutdoorLight {
  double global_lux = 0.0;
  double diffuse_lux = 0.0;
};
OutdoorLight outdoor_light(const Weather& weather, const WeatherRecord& record);

/// Sums over all records.
struct WeatherSums {
  double global_klxh = 0.0;
  double diffuse_klxh = 0.0;
  double direct_normal_kwh_m2 = 0.0;
  double diffuse_horizontal_kwh_m2 = 0.0;
  double sunshine_h = 0.0;  ///< with a beam of at least 120 W/m² [WMO 2018]
  double sun_up_h = 0.0;
  double dark_h = 0.0;      ///< with the sun over 5° and no irradiance at all: likely holes in the data
  std::size_t missing = 0;  ///< records without irradiances
};
WeatherSums sums_of(const Weather& weather);

}  // namespace clerestory::lighting
