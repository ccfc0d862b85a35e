// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lighting/results.h"

namespace clerestory::io {

/// A column of a grid's light, or an array of its cells.
struct LightColumn {
  std::string name;
  std::vector<float> values;  ///< [sensors]
};

/// The columns of a grid:
/// `illuminance_lux,error_lux[,daylight_factor_percent][,cylindrical_lux,cylindrical_error_lux,modelling][,illuminance_lux_GROUP,error_lux_GROUP …]`.
/// Of several moments those of each, with `_MOMENT` behind their names.
/// @param moments  of one grid
std::vector<LightColumn> light_columns(std::span<const lighting::GridResult> moments);

/// A grid as a table, a sensor a line in the order of the sensors: `id,x,y,z,nx,ny,nz` and the light_columns(),
/// positions [m, model coordinates].
/// The id is the sensor's number from 0; of a list of given points those that were left out keep theirs.
/// Positions have six decimals (1 µm), normals nine significant digits, and light values the fewest digits that read
/// back as the same float. The bytes depend on the values alone, not on locale or threads.
/// A value that is not finite is our own bug: throws std::logic_error.
/// @param moments  of one grid; at least one
std::string grid_csv(std::span<const lighting::GridResult> moments);

/// Cylindrical by the sensors' own illuminance, 0 where that is; nothing where no cylindrical illuminance is told.
std::vector<float> modelling_of(const lighting::GridResult& grid);

/// The name of a group or moment as part of the name of a column: what would part columns becomes -.
std::string column_word(std::string_view name);

/// The name of a grid or an observer; of several moments with `_MOMENT` behind it.
std::string full_name(const lighting::GridResult& grid);
std::string full_name(const lighting::ObserverResult& observer);

/// Observers as a table, one a line: `name,x,y,z,look_x,look_y,look_z,ugr,ugr_error,background_cd_m2,indirect_vertical_lux`. The name is in
/// quotation marks; ugr is empty where nothing glares. Of several moments the last four columns come for each, with `_MOMENT` behind their names.
/// @param observers  each at all moments, one behind another, or once
std::string observers_csv(const std::vector<lighting::ObserverResult>& observers);

/// Writes grid_csv() to a file. Throws MachineError when it cannot be written whole.
void write_grid_csv(const std::filesystem::path& file, std::span<const lighting::GridResult> moments);

}  // namespace clerestory::io
