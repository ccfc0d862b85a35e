// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/weather.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace clerestory::lighting {

namespace {

constexpr double kSunshine = 120.0;  ///< [W/m²]
constexpr double kHighSun = 5.0;     ///< higher, no sky is dark [degrees]

/// Hours since the begin of a year in which every February has 29 days, so that records and moments of any year compare.
double hour_of_year(int month, int day, double hour) {
  constexpr std::array<int, 12> kBefore{0, 31, 60, 91, 121, 152, 182, 213, 244, 274, 305, 335};
  return 24.0 * (kBefore.at(static_cast<std::size_t>(month - 1)) + day - 1) + hour;
}

double hour_of(const WeatherRecord& r) { return hour_of_year(r.month, r.day, r.middle_h); }

/// The record whose middle comes next to an hour of the year; the end where there is none.
std::vector<WeatherRecord>::const_iterator next_to(const Weather& weather, double hour) {
  return std::lower_bound(weather.records.begin(), weather.records.end(), hour,
                          [](const WeatherRecord& r, double h) { return hour_of(r) < h; });
}

bool has_irradiance(const WeatherRecord& r) { return r.direct_normal_w_m2 && r.diffuse_horizontal_w_m2; }

}  // namespace

SunPosition sun_of(const Weather& weather, const WeatherRecord& record) {
  const Air standard;
  return sun_position(
      weather.site, {record.year, record.month, record.day, record.middle_h},
      {record.pressure_mbar.value_or(standard.pressure_mbar), record.temperature_c.value_or(standard.temperature_c)});
}

Irradiance irradiance_of(const WeatherRecord& record) {
  Irradiance result;
  result.direct_normal_w_m2 = record.direct_normal_w_m2.value_or(0.0);
  result.diffuse_horizontal_w_m2 = record.diffuse_horizontal_w_m2.value_or(0.0);
  result.dew_point_c = record.dew_point_c.value_or(result.dew_point_c);
  result.day_of_year = day_of_year({record.year, record.month, record.day, 12.0});
  return result;
}

std::optional<Irradiance> irradiance_at(const Weather& weather, const Moment& moment) {
  // A typical year has no 29th of February: the day before stands for it.
  const bool leap_day = moment.month == 2 && moment.day == 29;
  const bool has_it = std::any_of(weather.records.begin(), weather.records.end(),
                                  [](const WeatherRecord& r) { return r.month == 2 && r.day == 29; });
  const double hour = hour_of_year(moment.month, leap_day && !has_it ? 28 : moment.day, moment.hour);
  const auto after = next_to(weather, hour);
  const WeatherRecord* b = after == weather.records.end() ? nullptr : &*after;
  const WeatherRecord* a = after == weather.records.begin() ? nullptr : &*(after - 1);
  const auto near = [&](const WeatherRecord* r) {
    return r != nullptr && has_irradiance(*r) && std::abs(hour_of(*r) - hour) <= weather.interval_h;
  };
  if (!near(a)) a = near(b) ? b : nullptr;
  if (!near(b)) b = a;
  if (a == nullptr) return std::nullopt;
  const Irradiance first = irradiance_of(*a);
  const Irradiance second = irradiance_of(*b);
  const double share = a == b ? 0.0 : (hour - hour_of(*a)) / (hour_of(*b) - hour_of(*a));
  const auto between = [share](double x, double y) { return x + share * (y - x); };
  return Irradiance{between(first.direct_normal_w_m2, second.direct_normal_w_m2),
                    between(first.diffuse_horizontal_w_m2, second.diffuse_horizontal_w_m2),
                    between(first.dew_point_c, second.dew_point_c), day_of_year(moment)};
}

Air air_at(const Weather& weather, const Moment& moment) {
  Air air;
  const auto record = next_to(weather, hour_of_year(moment.month, moment.day, moment.hour));
  if (record == weather.records.end()) return air;
  air.pressure_mbar = record->pressure_mbar.value_or(air.pressure_mbar);
  air.temperature_c = record->temperature_c.value_or(air.temperature_c);
  return air;
}

OutdoorLight outdoor_light(const Weather& weather, const WeatherRecord& record) {
  const Irradiance irradiance = irradiance_of(record);
  if (irradiance.direct_normal_w_m2 <= 0.0 && irradiance.diffuse_horizontal_w_m2 <= 0.0) return {};
  constexpr double kRad = 0.017453292519943295;
  const double altitude = sun_of(weather, record).altitude_deg * kRad;
  const DaylightIlluminance light = illuminance_of(irradiance, clearness_of(irradiance, 90.0 * kRad - altitude));
  const double by_sun = light.direct_normal_lux * std::max(0.0, std::sin(altitude));
  return {light.diffuse_horizontal_lux + by_sun, light.diffuse_horizontal_lux};
}

WeatherSums sums_of(const Weather& weather) {
  WeatherSums sums;
  const double hours = weather.interval_h;
  for (const WeatherRecord& record : weather.records) {
    if (!has_irradiance(record)) ++sums.missing;
    const OutdoorLight light = outdoor_light(weather, record);
    const Irradiance irradiance = irradiance_of(record);
    sums.global_klxh += 1e-3 * hours * light.global_lux;
    sums.diffuse_klxh += 1e-3 * hours * light.diffuse_lux;
    sums.direct_normal_kwh_m2 += 1e-3 * hours * irradiance.direct_normal_w_m2;
    sums.diffuse_horizontal_kwh_m2 += 1e-3 * hours * irradiance.diffuse_horizontal_w_m2;
    if (irradiance.direct_normal_w_m2 >= kSunshine) sums.sunshine_h += hours;
    const double altitude = sun_of(weather, record).altitude_deg;
    if (altitude > 0.0) sums.sun_up_h += hours;
    const bool dark = irradiance.direct_normal_w_m2 <= 0.0 && irradiance.diffuse_horizontal_w_m2 <= 0.0;
    if (dark && altitude > kHighSun && has_irradiance(record)) sums.dark_h += hours;
  }
  return sums;
}

}  // namespace clerestory::lighting
