// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "io/epw.h"
#include "io/study_tables.h"
#include "lighting/sun_position.h"
#include "lighting/weather.h"

namespace clerestory::io {

namespace {

using lighting::Moment;
using lighting::Site;
using lighting::Weather;

/// A moment as the study has it, with an offset from UTC where it gives one.
struct GivenTime {
  Moment moment;
  std::optional<double> offset_h;
  std::string name;  ///< for columns
};

/// "2026-03-21T1200", with seconds where they are not zero, and the offset from UTC where one is given.
std::string name_of(const std::string& time, double second, const std::string& offset) {
  constexpr std::size_t kDay = 10;
  constexpr std::size_t kUpToMinutes = 16;
  std::string name = time.substr(0, kDay) + "T";
  for (const char c : time.substr(kDay + 1, second != 0.0 ? std::string::npos : kUpToMinutes - kDay - 1) + offset) {
    if (c != ':') name += c;
  }
  return name;
}

GivenTime parse_time(const StudyValue& value) {
  GivenTime time;
  Moment& m = time.moment;
  int hour = 0;
  int minute = 0;
  double second = 0.0;
  int read = 0;
  const int found = std::sscanf(value.text.c_str(), "%4d-%2d-%2d%*1[T t]%2d:%2d:%lf%n", &m.year, &m.month, &m.day,
                                &hour, &minute, &second, &read);
  if (found < 6)
    throw value.error(fmt::format("sky.time is {}, expected a day and a time", value.text),
                      "write for example time = 2026-03-21T12:00:00");
  m.hour = hour + minute / 60.0 + second / 3600.0;
  const std::string rest = value.text.substr(static_cast<std::size_t>(read));
  if (rest == "Z" || rest == "z") time.offset_h = 0.0;
  char sign = '+';
  if (std::sscanf(rest.c_str(), "%c%2d:%2d", &sign, &hour, &minute) == 3)
    time.offset_h = (sign == '-' ? -1.0 : 1.0) * (hour + minute / 60.0);
  time.name = name_of(value.text.substr(0, static_cast<std::size_t>(read)), second, rest);
  return time;
}

double required(const StudyValue* site, const char* key, const StudyValue& time, const char* example) {
  const StudyValue* value = site != nullptr ? site->find(key) : nullptr;
  if (value == nullptr)
    throw time.error(fmt::format("sky.time needs site.{}", key),
                     fmt::format("write {} into [site], or give a weather file", example));
  return value->number;
}

Site site_of(const StudyValue* table, const GivenTime& time, const StudyValue& where,
             const std::optional<Weather>& weather, lighting::Study& study) {
  Site site;
  const bool own_place = table != nullptr && table->find("latitude") != nullptr;
  if (weather && !own_place) {
    site = weather->site;
    study.assumptions.push_back(fmt::format(
        "The building stands where the weather was measured: {}, latitude {:.4f}, longitude {:.4f} degrees.",
        weather->place, site.latitude_deg, site.longitude_deg));
  } else {
    site.latitude_deg = required(table, "latitude", where, "latitude = 48.1");
    site.longitude_deg = required(table, "longitude", where, "longitude = 11.6");
  }
  if (time.offset_h) {
    site.timezone_h = *time.offset_h;
  } else if (const StudyValue* zone = table != nullptr ? table->find("timezone") : nullptr) {
    site.timezone_h = zone->number;
  } else if (weather) {
    site.timezone_h = weather->site.timezone_h;
  } else {
    required(table, "timezone", where, "timezone = 1.0");
  }
  return site;
}

/// The file of site.weather, where the sky is that of the weather or the study leaves its place to it.
std::optional<Weather> weather_of(const StudyValue& sky, const StudyValue* site, StudyPlace& place) {
  const bool asked_for = text_or(sky, "type", "") == "weather";
  const StudyValue* file = site != nullptr ? site->find("weather") : nullptr;
  if (asked_for && file == nullptr)
    throw sky.find("type")->error("sky.type = \"weather\" needs site.weather",
                                  "write weather = \"place.epw\" into [site]");
  const bool has_place = site != nullptr && site->find("latitude") != nullptr && site->find("timezone") != nullptr;
  if (file == nullptr || (!asked_for && has_place)) return std::nullopt;
  const std::filesystem::path path = place.folder / file->text;
  place.files.push_back(path);
  return read_weather(path);
}

/// The weather's irradiances at a moment.
lighting::Irradiance irradiance_of(const Weather& weather, const Moment& moment, const StudyValue& when,
                                   lighting::Study& study) {
  const auto irradiance = lighting::irradiance_at(weather, moment);
  if (!irradiance)
    throw when.error(fmt::format("the weather file has no irradiance at {}", when.text),
                     "choose another time, or sky.type = \"perez\"");
  study.assumptions.push_back(fmt::format(
      "The weather at {} is {:.0f} W/m2 direct normal and {:.0f} W/m2 diffuse: on the line between the middles of the "
      "file's intervals, which end at the times that stand in its rows. The sun is that of the moment.",
      when.text, irradiance->direct_normal_w_m2, irradiance->diffuse_horizontal_w_m2));
  return *irradiance;
}

/// The moment by the weather file's clock.
Moment by_clock_of(const Weather& weather, Moment moment, double timezone_h) {
  moment.hour += weather.site.timezone_h - timezone_h;
  if (moment.hour >= 0.0 && moment.hour < 24.0) return moment;
  const int step = moment.hour < 0.0 ? -1 : 1;
  moment.hour -= 24.0 * step;
  moment.day += step;
  if (moment.day < 1) {
    moment.month = moment.month == 1 ? 12 : moment.month - 1;
    moment.day = lighting::days_in_month(moment.year, moment.month);
  } else if (moment.day > lighting::days_in_month(moment.year, moment.month)) {
    moment.day = 1;
    moment.month = moment.month % 12 + 1;
  }
  return moment;
}

StudySun at_time(const StudyValue& root, const StudyValue& sky, const StudyValue& when,
                 const std::optional<Weather>& weather, lighting::Study& study) {
  const GivenTime time = parse_time(when);
  const Site site = site_of(find_table(root, "site"), time, when, weather, study);
  StudySun sun;
  lighting::Air air;
  sun.moment = time.name;
  sun.day_of_year = lighting::day_of_year(time.moment);
  if (weather) {
    const Moment moment = by_clock_of(*weather, time.moment, site.timezone_h);
    if (text_or(sky, "type", "") == "weather") sun.irradiance = irradiance_of(*weather, moment, when, study);
    air = lighting::air_at(*weather, moment);
  }
  const lighting::SunPosition position = lighting::sun_position(site, time.moment, air);
  sun.altitude_deg = position.altitude_deg;
  sun.towards = lighting::direction_of(position.altitude_deg, position.azimuth_deg, study.north_deg);
  study.assumptions.push_back(fmt::format("At {} the sun stands at altitude {:.2f} and azimuth {:.2f} degrees.",
                                          when.text, position.altitude_deg, position.azimuth_deg));
  return sun;
}

/// A moment that is given twice counts once.
std::vector<StudySun> at_times(const StudyValue& root, const StudyValue& sky, const StudyValue& times,
                               StudyPlace& place, lighting::Study& study) {
  const std::optional<Weather> weather = weather_of(sky, find_table(root, "site"), place);
  if (times.kind != StudyValue::Kind::kArray) return {at_time(root, sky, times, weather, study)};
  std::vector<StudySun> suns;
  for (const StudyValue& when : times.children) {
    const std::string name = parse_time(when).name;
    const bool again = std::any_of(suns.begin(), suns.end(), [&](const StudySun& sun) { return sun.moment == name; });
    if (again)
      study.assumptions.push_back(fmt::format("The moment {} is given twice; it counts once.", when.text));
    else
      suns.push_back(at_time(root, sky, when, weather, study));
  }
  return suns;
}

}  // namespace

std::vector<StudySun> read_study_suns(const StudyValue& root, StudyPlace& place, lighting::Study& study) {
  const StudyValue& sky = *root.find("sky");
  const StudyValue* time = sky.find("time");
  const StudyValue* altitude = sky.find("sun_altitude");
  const StudyValue* azimuth = sky.find("sun_azimuth");
  if (time != nullptr && (altitude != nullptr || azimuth != nullptr))
    throw time->error("sky.time and sky.sun_altitude or sky.sun_azimuth both say where the sun stands",
                      "give one of them");
  if (time != nullptr) return at_times(root, sky, *time, place, study);
  if (text_or(sky, "type", "") == "weather")
    throw sky.find("type")->error("sky.type = \"weather\" needs sky.time",
                                  "write for example time = 2026-03-21T12:00:00");
  if (altitude == nullptr && azimuth == nullptr) return {};
  if (altitude == nullptr || azimuth == nullptr)
    throw(altitude != nullptr ? altitude : azimuth)
        ->error("the sun needs both sky.sun_altitude and sky.sun_azimuth", "give both, or sky.time");
  StudySun sun;
  sun.altitude_deg = altitude->number;
  sun.towards = lighting::direction_of(altitude->number, azimuth->number, study.north_deg);
  return {sun};
}

}  // namespace clerestory::io
