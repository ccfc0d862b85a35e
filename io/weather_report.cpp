// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/weather_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "io/map_scale.h"
#include "io/raster_text.h"

namespace clerestory::io {

namespace {

using lighting::Weather;
using lighting::WeatherRecord;
using lighting::WeatherSums;

constexpr std::array kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};

WeatherSums sums_of_month(const Weather& weather, int month) {
  Weather part = weather;
  std::erase_if(part.records, [month](const WeatherRecord& r) { return r.month != month; });
  return lighting::sums_of(part);
}

std::string years_of(const Weather& weather) {
  std::set<int> years;
  for (const WeatherRecord& r : weather.records) years.insert(r.year);
  return years.size() == 1 ? std::to_string(*years.begin())
                           : fmt::format("{} to {}, mixed", *years.begin(), *years.rbegin());
}

// The picture's measures [pixels].
constexpr int kDayWidth = 3;
constexpr int kHourHeight = 16;
constexpr int kLeft = 60;
constexpr int kTop = 60;
constexpr int kBottom = 50;
constexpr int kDays = 366;
constexpr int kLegend = 130;
constexpr Rgb kWhite{255, 255, 255};
constexpr Rgb kInk{40, 40, 40};
constexpr Rgb kNight{225, 225, 230};

/// A year with as many days as the records have.
int calendar_of(const Weather& weather) {
  const bool leap = std::any_of(weather.records.begin(), weather.records.end(),
                                [](const WeatherRecord& r) { return r.month == 2 && r.day == 29; });
  return leap ? 2000 : 2001;
}

/// From 0.
int day_number(int year, int month, int day) { return lighting::day_of_year({year, month, day, 12.0}) - 1; }

struct Cell {
  int day;
  double from_h, to_h;
  float lux;
  bool known;
};

std::vector<Cell> cells_of(const Weather& weather) {
  std::vector<Cell> cells;
  const int year = calendar_of(weather);
  for (const WeatherRecord& r : weather.records) {
    cells.push_back({day_number(year, r.month, r.day), r.middle_h - 0.5 * weather.interval_h,
                     r.middle_h + 0.5 * weather.interval_h,
                     static_cast<float>(lighting::outdoor_light(weather, r).global_lux),
                     r.direct_normal_w_m2.has_value() && r.diffuse_horizontal_w_m2.has_value()});
  }
  return cells;
}

void draw_cells(Raster& picture, const std::vector<Cell>& cells, const MapScale& scale) {
  for (const Cell& c : cells) {
    const double top = kTop + kHourHeight * (24.0 - c.to_h);
    const PixelRect place{static_cast<double>(kLeft + kDayWidth * c.day), top, kDayWidth,
                          kHourHeight * (c.to_h - c.from_h)};
    picture.fill(place, !c.known ? kWhite : c.lux > 0.0F ? map_colour(scale.position(c.lux)) : kNight);
  }
}

void draw_axes(Raster& picture, int year) {
  for (int hour = 0; hour <= 24; hour += 3) {
    const double y = kTop + kHourHeight * (24.0 - hour);
    draw_text(picture, fmt::format("{}:00", hour), {13}, {kLeft - 6.0, y}, {Align::kEnd, Align::kMiddle}, kInk);
    picture.fill({kLeft - 4.0, y, 4.0, 1.0}, kInk);
  }
  for (int month = 1; month <= 12; ++month) {
    const double x = kLeft + kDayWidth * day_number(year, month, 1);
    picture.fill({x, kTop + 24.0 * kHourHeight, 1.0, 6.0}, kInk);
    draw_text(picture, kMonths.at(static_cast<std::size_t>(month - 1)), {13},
              {x + 15.0 * kDayWidth, kTop + 24.0 * kHourHeight + 8.0}, {Align::kMiddle, Align::kStart}, kInk);
  }
}

void draw_legend(Raster& picture, const MapScale& scale) {
  constexpr int kHeight = 24 * kHourHeight;
  const double x = kLeft + kDays * kDayWidth + 24.0;
  for (int i = 0; i < kHeight; ++i)
    picture.fill({x, static_cast<double>(kTop + i), 18.0, 1.0}, map_colour(1.0 - (i + 0.5) / kHeight));
  for (const double knot : scale.knots) {
    const double y = kTop + kHeight * (1.0 - scale.position(knot));
    draw_text(picture, fmt::format("{:g}", knot / 1000.0), {13}, {x + 24.0, y}, {Align::kStart, Align::kMiddle}, kInk);
  }
  draw_text(picture, "klx", {13, true}, {x, kTop - 10.0}, {Align::kStart, Align::kEnd}, kInk);
}

}  // namespace

std::string weather_text(const Weather& weather, const std::string& file) {
  const WeatherSums year = lighting::sums_of(weather);
  std::string text = fmt::format(
      "{}: weather of {}\n\nlatitude {:.4f}, longitude {:.4f} degrees, {:+g} h from UTC, {:.0f} m above the sea\n"
      "{} records of {:g} h, years {}; {} without irradiance\n"
      "the sun stands in the middle of each interval, which ends at the time in its row\n\n",
      file, weather.place, weather.site.latitude_deg, weather.site.longitude_deg, weather.site.timezone_h,
      weather.elevation_m, weather.records.size(), weather.interval_h, years_of(weather), year.missing);
  const auto row = [&](const char* name, const WeatherSums& s) {
    text += fmt::format("{:<6}{:>15.0f}{:>15.0f}{:>15.1f}{:>16.1f}{:>12.0f}{:>12.0f}\n", name, s.global_klxh,
                        s.diffuse_klxh, s.direct_normal_kwh_m2, s.diffuse_horizontal_kwh_m2, s.sunshine_h, s.sun_up_h);
  };
  text += fmt::format("{:<6}{:>15}{:>15}{:>15}{:>16}{:>12}{:>12}\n", "", "global klx h", "diffuse klx h",
                      "direct kWh/m2", "diffuse kWh/m2", "sunshine h", "sun up h");
  for (int month = 1; month <= 12; ++month)
    row(kMonths.at(static_cast<std::size_t>(month - 1)), sums_of_month(weather, month));
  row("all", year);
  if (year.dark_h > 0.0)
    text += fmt::format(
        "\nnote: {:g} h have no irradiance although the sun stands over 5 degrees; the data may have holes there\n",
        year.dark_h);
  return text;
}

std::string weather_json(const Weather& weather, const std::string& file, const std::string& version) {
  const WeatherSums s = lighting::sums_of(weather);
  const nlohmann::ordered_json json{{"file", file},
                                    {"version", version},
                                    {"place", weather.place},
                                    {"latitude_deg", weather.site.latitude_deg},
                                    {"longitude_deg", weather.site.longitude_deg},
                                    {"timezone_h", weather.site.timezone_h},
                                    {"elevation_m", weather.elevation_m},
                                    {"records", weather.records.size()},
                                    {"interval_h", weather.interval_h},
                                    {"years", years_of(weather)},
                                    {"records_without_irradiance", s.missing},
                                    {"global_klxh", s.global_klxh},
                                    {"diffuse_klxh", s.diffuse_klxh},
                                    {"direct_normal_kwh_m2", s.direct_normal_kwh_m2},
                                    {"diffuse_horizontal_kwh_m2", s.diffuse_horizontal_kwh_m2},
                                    {"sunshine_h", s.sunshine_h},
                                    {"sun_up_h", s.sun_up_h},
                                    {"dark_h", s.dark_h}};
  return json.dump(2) + "\n";
}

Raster weather_picture(const Weather& weather) {
  Raster picture(kLeft + kDays * kDayWidth + kLegend, kTop + 24 * kHourHeight + kBottom, kWhite);
  const std::vector<Cell> cells = cells_of(weather);
  std::vector<float> lux;
  for (const Cell& c : cells) lux.push_back(c.lux);
  const MapScale scale = choose_scale(lux, MapQuantity::kIlluminance);
  draw_cells(picture, cells, scale);
  draw_axes(picture, calendar_of(weather));
  draw_legend(picture, scale);
  draw_text(picture, "Global horizontal illuminance, " + weather.place, {17, true}, {kLeft, 14.0},
            {Align::kStart, Align::kStart}, kInk);
  return picture;
}

}  // namespace clerestory::io
