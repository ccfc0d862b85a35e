// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lighting/study.h"

namespace clerestory::test {

/// A reference scene of validation_dir(), read by means of its own: no reader of the program has a part in it.
/// The study is one of daylight or, where something shines, one of illuminance without a sky; its only grid "workplane" holds
/// the sensors. `name` is the folder: "office", "lamp-room", "atrium". Throws std::runtime_error where a file is missing.
lighting::Study validation_study(const std::string& name);

/// What the reference says, a value a sensor.
struct Reference {
  std::vector<double> illuminance_lux;
  std::vector<double> standard_error_lux;  ///< zeros where the file gives none
};
Reference validation_reference(const std::string& name);

/// The same scene as a study file for the program: writes NAME.toml into a folder, with the model and the sensors read in place.
/// Returns its path.
std::filesystem::path write_validation_study(const std::string& name, const std::filesystem::path& folder,
                                             double accuracy);

}  // namespace clerestory::test
