// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "io/raster.h"
#include "lighting/weather.h"

namespace clerestory::io {

/// What is in a weather file, for a reader at a terminal: place, records, sums over the year and by month.
/// @param file  as the user named it
std::string weather_text(const lighting::Weather& weather, const std::string& file);

/// The same as JSON.
/// @param version  of the program
std::string weather_json(const lighting::Weather& weather, const std::string& file, const std::string& version);

/// The year in false colour: a column a day from January on, hours of the clock upwards, the global horizontal illuminance by colour.
Raster weather_picture(const lighting::Weather& weather);

}  // namespace clerestory::io
