// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "io/model_file.h"

namespace clerestory::io {

/// Whether a file that begins so is SDF.
bool is_sdf(std::string_view head);

/// Reads a world or a model in SDF, as robot simulators describe houses: the meshes of all visuals, each at the product of its poses.
/// A model is a part, by its name in the world. model://NAME is looked for beside the file, in the folders over it and their folder
/// `models`; where no folder has that name, one that is named like its end behind an underscore serves. Metres, z up.
/// Left out and told: models that are not there, visuals that are no meshes, lights. Collision shapes are no surfaces.
/// Throws InputError for no sound XML, poses that are none or relative to other frames, a mesh that is not there or at fault, models that
/// include each other, over 100 000 visuals, and a world without any mesh.
/// Source: Open Robotics, SDFormat specification 1.6, 2016.
ModelFile read_sdf(const std::filesystem::path& path, const ModelFormat& format = {});

}  // namespace clerestory::io
