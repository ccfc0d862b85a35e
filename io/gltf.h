// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "io/model_file.h"

namespace clerestory::io {

/// Whether a file that begins so is a GLB.
bool is_glb(std::string_view head);

/// Reads glTF, as text with its buffers or as GLB, by assimp in a child process. Metres and y up, unless the format says otherwise.
/// A node that holds polygons is a part. Of a material are told: the base colour, which is linear, split into a diffuse and a metallic
/// part; alpha as opacity where the mode is BLEND; KHR_materials_transmission as transmittance; that it emits. Single precision: a
/// notice tells where that is coarser than 1 mm.
/// Throws InputError for what is no glTF or names a buffer that is not there, for a corner that does not exist, a model without faces,
/// and where read_in_child() does.
/// Source: Khronos Group, glTF 2.0 specification, 2021.
ModelFile read_gltf(const std::filesystem::path& path, const ModelFormat& format = {});

/// What read_gltf() runs in the child process.
ModelFile import_gltf(const std::filesystem::path& path, const ModelFormat& format);

}  // namespace clerestory::io
