// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/epw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

using lighting::Weather;
using lighting::WeatherRecord;

constexpr std::size_t kHeaderLines = 8;
constexpr std::size_t kLeastFields = 16;  ///< up to the diffuse irradiance; what follows is not used
constexpr std::size_t kMostRecords = 366UL * 24 * 60;
constexpr double kMostIrradiance = 2000.0;  ///< [W/m²]
constexpr int kFirstYear = 1850;
constexpr int kLastYear = 2200;

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(trim(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

[[noreturn]] void refuse(const LineReader& in, const std::string& what, const std::string& hint) {
  throw InputError(in.file(), in.number(), what, hint);
}

double number_in(const LineReader& in, std::string_view field, const char* what, double low, double high) {
  const auto value = parse_number(field);
  if (!value || !(*value >= low && *value <= high))
    refuse(in, fmt::format("{} is {}, expected a number from {} to {}", what, in_quotes(field), low, high),
           "get the file anew, or mend the row");
  return *value;
}

int whole_in(const LineReader& in, std::string_view field, const char* what, int low, int high) {
  const double value = number_in(in, field, what, low, high);
  if (value != std::floor(value))
    refuse(in, fmt::format("{} is {}, expected a whole number", what, in_quotes(field)), "mend the row");
  return static_cast<int>(value);
}

/// A number, or none where the field is empty or at least as large as what stands for missing.
std::optional<double> optional_in(const LineReader& in, std::string_view field, const char* what, double missing,
                                  double low) {
  if (field.empty()) return std::nullopt;
  const double value = number_in(in, field, what, low, 1e9);
  if (value >= missing) return std::nullopt;
  return value;
}

std::optional<double> irradiance_in(const LineReader& in, std::string_view field, const char* what) {
  auto value = optional_in(in, field, what, 9999.0, -9999.0);
  if (!value) return value;
  if (*value > kMostIrradiance)
    refuse(in, fmt::format("{} is {} W/m2, more than the sun gives", what, *value),
           "mend the row, or write 9999 for a missing value");
  // Interpolated sources go a little below zero at night.
  return std::max(0.0, *value);
}

void check_date(const LineReader& in, const WeatherRecord& r) {
  // Any year may have its 29th of February: rows of a typical year carry the years that they were taken from.
  const int days = r.month == 2 ? 29 : lighting::days_in_month(2001, r.month);
  if (r.day > days) refuse(in, fmt::format("month {} has no day {}", r.month, r.day), "mend the date");
}

/// The records of an EPW, one after the other without a gap.
class EpwRows {
 public:
  EpwRows(Weather& weather, int an_hour) : weather_(weather), an_hour_(an_hour) {}

  void add(const LineReader& in) {
    const std::vector<std::string_view> fields = fields_of(in.line());
    if (fields.size() < kLeastFields)
      refuse(in, fmt::format("the row has {} of the {} fields that are needed", fields.size(), kLeastFields),
             "the file may be cut off; get it anew");
    WeatherRecord r;
    r.year = whole_in(in, fields[0], "the year", kFirstYear, kLastYear);
    r.month = whole_in(in, fields[1], "the month", 1, 12);
    r.day = whole_in(in, fields[2], "the day", 1, 31);
    const int hour = whole_in(in, fields[3], "the hour", 1, 24);
    check_date(in, r);
    expect_next(in, r, hour);
    r.middle_h = hour - 1 + (part_ + 0.5) / an_hour_;
    r.temperature_c = optional_in(in, fields[6], "the dry bulb temperature", 99.9, -200.0);
    r.dew_point_c = optional_in(in, fields[7], "the dew point", 99.9, -200.0);
    if (const auto pascal = optional_in(in, fields[9], "the pressure", 999999.0, 0.0))
      r.pressure_mbar = *pascal / 100.0;
    const auto global = irradiance_in(in, fields[13], "the global irradiance");
    r.direct_normal_w_m2 = irradiance_in(in, fields[14], "the direct normal irradiance");
    r.diffuse_horizontal_w_m2 = irradiance_in(in, fields[15], "the diffuse irradiance");
    fill_in(global, r);
    weather_.records.push_back(r);
    if (weather_.records.size() > kMostRecords)
      refuse(in, "there are more rows than minutes in a year", "give a file of one year");
  }

  void finish(const std::string& file) const {
    const std::size_t a_day = 24U * static_cast<std::size_t>(an_hour_);
    const std::size_t rows = weather_.records.size();
    if (rows == 365 * a_day || rows == 366 * a_day) return;
    throw InputError(
        file, 0, fmt::format("the file has {} rows of weather, a year has {} or {}", rows, 365 * a_day, 366 * a_day),
        "get a whole year; DATA PERIODS in the header tells how many rows make an hour");
  }

 private:
  /// Without the beam, or the diffuse part, global irradiance tells it where the sun stands high enough.
  void fill_in(const std::optional<double>& global, WeatherRecord& r) const {
    if (!global || (r.direct_normal_w_m2 && r.diffuse_horizontal_w_m2)) return;
    constexpr double kLeastSine = 0.05;
    const double sine = std::sin(lighting::sun_of(weather_, r).altitude_deg * 0.017453292519943295);
    if (r.direct_normal_w_m2)
      r.diffuse_horizontal_w_m2 = std::max(0.0, *global - *r.direct_normal_w_m2 * std::max(0.0, sine));
    else if (r.diffuse_horizontal_w_m2 && sine > kLeastSine)
      r.direct_normal_w_m2 = std::max(0.0, (*global - *r.diffuse_horizontal_w_m2) / sine);
  }

  void expect_next(const LineReader& in, const WeatherRecord& r, int hour) {
    if (!weather_.records.empty()) {
      part_ = (part_ + 1) % an_hour_;
      if (part_ == 0) step();
    }
    if (r.month == month_ && r.day == day_ && hour == hour_) return;
    // The year may be a leap year, or not.
    if (part_ == 0 && hour_ == 1 && month_ == 2 && day_ == 29 && r.month == 3 && r.day == 1 && hour == 1) {
      month_ = 3;
      day_ = 1;
      return;
    }
    refuse(
        in,
        fmt::format("hour {} of {}/{} stands where hour {} of {}/{} is due: rows are missing, doubled or out of order",
                    hour, r.month, r.day, hour_, month_, day_),
        "get the file anew, or mend the rows");
  }

  void step() {
    if (++hour_ <= 24) return;
    hour_ = 1;
    const int days = month_ == 2 ? 29 : lighting::days_in_month(2001, month_);
    if (++day_ <= days) return;
    day_ = 1;
    month_ = month_ % 12 + 1;
  }

  Weather& weather_;
  int an_hour_;
  int part_ = 0;
  int month_ = 1;
  int day_ = 1;
  int hour_ = 1;
};

void read_location(const LineReader& in, Weather& weather) {
  const std::vector<std::string_view> fields = fields_of(in.line());
  if (fields.size() < 10 || lower(fields[0]) != "location")
    refuse(in, "an EPW begins with LOCATION and nine fields", "give an EPW file");
  weather.place = printable(fields[1]);
  weather.site = {number_in(in, fields[6], "the latitude", -90.0, 90.0),
                  number_in(in, fields[7], "the longitude", -180.0, 180.0),
                  number_in(in, fields[8], "the time zone", -12.0, 14.0)};
  weather.elevation_m = number_in(in, fields[9], "the elevation", -1000.0, 9999.9);
}

/// Rows an hour, as DATA PERIODS says.
int rows_an_hour(const LineReader& in) {
  const std::vector<std::string_view> fields = fields_of(in.line());
  if (fields.size() < 3 || lower(fields[0]) != "data periods")
    refuse(in, "the eighth line of an EPW is DATA PERIODS with the number of rows an hour",
           "the header may be cut off; get the file anew");
  const int rows = whole_in(in, fields[2], "the number of rows an hour", 1, 60);
  if (60 % rows != 0) refuse(in, fmt::format("{} rows an hour do not divide it", rows), "mend DATA PERIODS");
  return rows;
}

Weather read_epw(const std::filesystem::path& path) {
  LineReader in(path, "weather");
  Weather weather;
  int an_hour = 1;
  for (std::size_t i = 0; i < kHeaderLines; ++i) {
    if (!in.next())
      throw InputError(path.string(), 0,
                       fmt::format("the file ends after {} of the {} lines of its header", i, kHeaderLines),
                       "get the file anew");
    if (i == 0) read_location(in, weather);
    if (i + 1 == kHeaderLines) an_hour = rows_an_hour(in);
  }
  weather.interval_h = 1.0 / an_hour;
  EpwRows rows(weather, an_hour);
  while (in.next()) {
    if (!trim(in.line()).empty()) rows.add(in);
  }
  rows.finish(path.string());
  return weather;
}

/// A line "name value" of a .wea's header.
std::string header_value(LineReader& in, std::string_view name, const std::filesystem::path& path) {
  if (!in.next())
    throw InputError(path.string(), 0, fmt::format("the file ends where '{}' is due", name), "get the file anew");
  const std::string_view line = trim(in.line());
  if (!line.starts_with(name))
    refuse(in, fmt::format("'{}' is due here", name), "give a .wea file with the six lines of its header");
  return std::string(trim(line.substr(name.size())));
}

Weather read_wea(const std::filesystem::path& path) {
  LineReader in(path, "weather");
  Weather weather;
  weather.place = printable(header_value(in, "place", path));
  const std::string latitude = header_value(in, "latitude", path);
  weather.site.latitude_deg = number_in(in, latitude, "the latitude", -90.0, 90.0);
  const std::string west = header_value(in, "longitude", path);
  weather.site.longitude_deg = -number_in(in, west, "the longitude (west positive)", -180.0, 180.0);
  const std::string meridian = header_value(in, "time_zone", path);
  weather.site.timezone_h = -number_in(in, meridian, "the time zone's meridian (west positive)", -210.0, 180.0) / 15.0;
  const std::string elevation = header_value(in, "site_elevation", path);
  weather.elevation_m = number_in(in, elevation, "the elevation", -1000.0, 9999.9);
  const std::string units = header_value(in, "weather_data_file_units", path);
  if (units != "1")
    refuse(in, fmt::format("weather_data_file_units is {}, and 1 (irradiances) is what is read", in_quotes(units)),
           "write direct normal and diffuse horizontal irradiances");
  double last = -1.0;
  while (in.next()) {
    const auto words = split_words(in.line());
    if (words.empty()) continue;
    if (words.size() < 5)
      refuse(in, fmt::format("the row has {} of 5 numbers", words.size()), "the file may be cut off; get it anew");
    WeatherRecord r;
    r.year = 2001;
    r.month = whole_in(in, words[0], "the month", 1, 12);
    r.day = whole_in(in, words[1], "the day", 1, 31);
    check_date(in, r);
    r.middle_h = number_in(in, words[2], "the hour", 0.0, 24.0);
    r.direct_normal_w_m2 = irradiance_in(in, words[3], "the direct normal irradiance");
    r.diffuse_horizontal_w_m2 = irradiance_in(in, words[4], "the diffuse irradiance");
    const double now = 24.0 * (31 * r.month + r.day) + r.middle_h;
    if (now <= last) refuse(in, "the row is not later than the one before", "sort the rows");
    if (last >= 0.0 && now - last < weather.interval_h) weather.interval_h = now - last;
    last = now;
    weather.records.push_back(r);
    if (weather.records.size() > kMostRecords)
      refuse(in, "there are more rows than minutes in a year", "give a file of one year");
  }
  if (weather.records.empty()) throw InputError(path.string(), 0, "there are no rows of weather", "get the file anew");
  return weather;
}

}  // namespace

bool is_weather_file(const std::filesystem::path& path) {
  const std::string extension = lower(path.extension().string());
  return extension == ".epw" || extension == ".wea";
}

Weather read_weather(const std::filesystem::path& path) {
  require_file(path, "weather");
  if (lower(path.extension().string()) == ".wea") return read_wea(path);
  if (lower(path.extension().string()) == ".epw") return read_epw(path);
  throw InputError(path.string(), 0, fmt::format("{} is no weather", in_quotes(path.filename().string())),
                   "give an .epw or .wea file");
}

}  // namespace clerestory::io
