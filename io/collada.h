// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "io/model_file.h"

namespace clerestory::io {

/// Whether a file that begins so is COLLADA.
bool is_collada(std::string_view head);

/// Reads COLLADA by assimp in a child process. Unit and up axis are those of its <asset>: z, y, or x, which is turned to z; without a
/// <unit> the unit is guessed. A node that holds polygons is a part. Of a material are told its diffuse colour, taken as linear, its
/// opacity, and that it emits. Where a file has wholly transparent materials, its exporter meant transparency the other way
/// round: it is taken so, and said. Single precision: a notice tells where that is coarser than 1 mm.
/// Throws InputError with the line for what is no XML, for a unit that is no length, a polygon with holes, a corner that does not exist, a model without
/// faces, and where read_in_child() does.
/// Source: Khronos Group, COLLADA 1.4.1 specification, 2008.
ModelFile read_collada(const std::filesystem::path& path, const ModelFormat& format = {});

/// What read_collada() runs in the child process.
ModelFile import_collada(const std::filesystem::path& path, const ModelFormat& format);

}  // namespace clerestory::io
