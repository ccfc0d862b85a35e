// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "lighting/weather.h"

namespace clerestory::io {

/// Whether a file's name ends as that of weather: .epw or .wea.
bool is_weather_file(const std::filesystem::path& path);

/// Reads weather: EPW, hourly or finer, a whole year of 365 or 366 days whose months may come from several years; or Radiance's .wea with
/// irradiances, any part of a year. An EPW's hour ends at the time that stands in its row: the sun is that of half an interval before; a
/// .wea gives the middle itself. What the format marks as missing is missing in the records.
/// Sources: EnergyPlus Auxiliary Programs, EPW; Radiance, gendaymtx.
/// Throws InputError with file and line: no such format, rows that are missing, doubled or cut off, dates and numbers that are none.
lighting::Weather read_weather(const std::filesystem::path& path);

}  // namespace clerestory::io
