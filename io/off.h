// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "io/model_file.h"

namespace clerestory::io {

/// Whether the first bytes of a file can only be those of a text OFF.
bool is_off(std::string_view head);

/// Reads OFF as text: OFF, COFF, NOFF, STOFF and their mixtures, the word itself being optional, with comments. The part has the name of the
/// file; normals, colours and texture coordinates are passed over, and faces of one or two corners, which are points and lines.
/// Throws InputError with the line for: the binary and the n-dimensional kind, data that end before the header's counts, a coordinate that
/// is no finite number, a corner that does not exist, and a file without faces.
/// Source: Geomview manual, chapter 4, Object File Formats, OFF.
ModelFile read_off(const std::filesystem::path& path, const ModelFormat& format = {});

}  // namespace clerestory::io
