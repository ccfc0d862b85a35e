// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>

#include "io/whole_file.h"

namespace clerestory::io {

namespace {

/// Room for the longest number here, a double of 1e308 in fixed notation.
using Buffer = std::array<char, 400>;

void append(std::string& line, const Buffer& buffer, std::to_chars_result result) {
  line += ',';
  line += std::string_view(buffer.data(), result.ptr);
}

void expect_finite(double value, const std::string& grid) {
  if (!std::isfinite(value)) throw std::logic_error("grid '" + grid + "' holds a value that is not finite");
}

/// Micrometres, without trailing zeros and without "-0".
void append_coordinate(std::string& line, double value_m, const std::string& grid) {
  expect_finite(value_m, grid);
  Buffer buffer;
  auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value_m, std::chars_format::fixed, 6);
  while (result.ptr[-1] == '0') --result.ptr;
  if (result.ptr[-1] == '.') --result.ptr;
  if (std::string_view(buffer.data(), result.ptr) == "-0") {
    line += ",0";
    return;
  }
  append(line, buffer, result);
}

void append_direction(std::string& line, double value, const std::string& grid) {
  expect_finite(value, grid);
  Buffer buffer;
  append(line, buffer,
         std::to_chars(buffer.data(), buffer.data() + buffer.size(), value + 0.0, std::chars_format::general, 9));
}

void append_light(std::string& line, float value, const std::string& grid) {
  expect_finite(value, grid);
  Buffer buffer;
  append(line, buffer, std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed));
}

void expect_whole(const lighting::GridResult& grid) {
  const std::size_t count = grid.sensors.count();
  const bool has_df = !grid.daylight_factor_percent.empty();
  if (grid.sensors.normals.size() != count || grid.illuminance_lux.size() != count || grid.error_lux.size() != count ||
      (has_df && grid.daylight_factor_percent.size() != count) ||
      (!grid.cylindrical_lux.empty() &&
       (grid.cylindrical_lux.size() != count || grid.cylindrical_error_lux.size() != count)) ||
      (!grid.sensors.ids.empty() && grid.sensors.ids.size() != count) ||
      std::any_of(grid.groups.begin(), grid.groups.end(), [&](const lighting::GroupColumn& group) {
        return group.illuminance_lux.size() != count || group.error_lux.size() != count;
      }))
    throw std::logic_error("grid '" + grid.name + "' has arrays of different lengths");
}

/// What stands behind the names of one of several moments.
std::string suffix(const std::string& moment) { return moment.empty() ? "" : "_" + column_word(moment); }

/// How many results each observer has, one behind another; at least one.
std::size_t moments_of(const std::vector<lighting::ObserverResult>& observers) {
  std::size_t count = 1;
  while (count < observers.size() && !observers[count].moment.empty() &&
         observers[count].moment != observers.front().moment)
    ++count;
  return count;
}

void append_glare(std::string& text, const lighting::ObserverResult& o) {
  if (std::isfinite(o.ugr))
    append_light(text, static_cast<float>(o.ugr), o.observer.name);
  else
    text += ',';
  for (const double x : {o.ugr_error, o.background_cd_m2, o.indirect_lux})
    append_light(text, static_cast<float>(x), o.observer.name);
}

}  // namespace

std::string column_word(std::string_view name) {
  std::string word(name);
  for (char& c : word) {
    if (c == ',' || c == ';' || c == '"' || c == ' ' || static_cast<unsigned char>(c) < 0x20) c = '-';
  }
  return word;
}

std::vector<float> modelling_of(const lighting::GridResult& grid) {
  std::vector<float> ratios;
  for (std::size_t i = 0; i < grid.cylindrical_lux.size(); ++i)
    ratios.push_back(grid.illuminance_lux[i] > 0.0F ? grid.cylindrical_lux[i] / grid.illuminance_lux[i] : 0.0F);
  return ratios;
}

std::string full_name(const lighting::GridResult& grid) { return grid.name + suffix(grid.moment); }
std::string full_name(const lighting::ObserverResult& observer) {
  return observer.observer.name + suffix(observer.moment);
}

std::vector<LightColumn> light_columns(std::span<const lighting::GridResult> moments) {
  std::vector<LightColumn> columns;
  for (const lighting::GridResult& grid : moments) {
    const std::string when = suffix(grid.moment);
    columns.push_back({"illuminance_lux" + when, grid.illuminance_lux});
    columns.push_back({"error_lux" + when, grid.error_lux});
    if (!grid.daylight_factor_percent.empty())
      columns.push_back({"daylight_factor_percent" + when, grid.daylight_factor_percent});
    if (!grid.cylindrical_lux.empty()) {
      columns.push_back({"cylindrical_lux" + when, grid.cylindrical_lux});
      columns.push_back({"cylindrical_error_lux" + when, grid.cylindrical_error_lux});
      columns.push_back({"modelling" + when, modelling_of(grid)});
    }
    for (const lighting::GroupColumn& group : grid.groups) {
      const std::string name = "_" + column_word(group.name) + when;
      columns.push_back({"illuminance_lux" + name, group.illuminance_lux});
      columns.push_back({"error_lux" + name, group.error_lux});
    }
  }
  return columns;
}

std::string grid_csv(std::span<const lighting::GridResult> moments) {
  for (const lighting::GridResult& grid : moments) expect_whole(grid);
  const lighting::GridResult& grid = moments.front();
  const std::vector<LightColumn> columns = light_columns(moments);
  std::string text = "id,x,y,z,nx,ny,nz";
  for (const LightColumn& column : columns) text += "," + column.name;
  text += '\n';
  const bool numbered = !grid.sensors.ids.empty();
  for (std::size_t i = 0; i < grid.sensors.count(); ++i) {
    text += std::to_string(numbered ? grid.sensors.ids[i] : i);
    const mesh::Point& p = grid.sensors.positions[i];
    const mesh::Vector& n = grid.sensors.normals[i];
    for (const double x : {p.x, p.y, p.z}) append_coordinate(text, x, grid.name);
    for (const double x : {n.x, n.y, n.z}) append_direction(text, x, grid.name);
    for (const LightColumn& column : columns) append_light(text, column.values[i], grid.name);
    text += '\n';
  }
  return text;
}

std::string observers_csv(const std::vector<lighting::ObserverResult>& observers) {
  const std::size_t moments = moments_of(observers);
  std::string text = "name,x,y,z,look_x,look_y,look_z";
  for (std::size_t m = 0; m < moments; ++m) {
    const std::string when = observers.empty() ? "" : suffix(observers[m].moment);
    for (const char* const column : {"ugr", "ugr_error", "background_cd_m2", "indirect_vertical_lux"})
      text += "," + (column + when);
  }
  text += '\n';
  for (std::size_t first = 0; first < observers.size(); first += moments) {
    const lighting::Observer& o = observers[first].observer;
    std::string name;
    for (const char c : o.name) name += c == '"' ? "\"\"" : std::string(1, c);
    text += '"' + name + '"';
    for (const double x : {o.eye.x, o.eye.y, o.eye.z}) append_coordinate(text, x, name);
    for (const double x : {o.look.x, o.look.y, o.look.z}) append_direction(text, x, name);
    for (std::size_t m = 0; m < moments; ++m) append_glare(text, observers[first + m]);
    text += '\n';
  }
  return text;
}

void write_grid_csv(const std::filesystem::path& file, std::span<const lighting::GridResult> moments) {
  write_whole_file(file, grid_csv(moments));
}

}  // namespace clerestory::io
