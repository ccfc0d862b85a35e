// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "io/model_file.h"

namespace clerestory::io {

/// Whether the first bytes of a file can only be those of a PLY.
bool is_ply(std::string_view head);

/// Reads PLY, text or binary of either byte order, with any types of numbers. Faces and triangle strips become polygons of one part, by the
/// name of the file, or of the parts and materials that the comments of write_model() name; other elements and properties are passed
/// over, colours and edges included.
/// Throws InputError with line, or element and byte, for: what read_ply_header() does, data that end before the header's counts, a coordinate
/// that is no finite number, a face with under 3 corners or a corner that does not exist, and a file without faces.
/// Source: Turk, The PLY Polygon File Format, 1994.
ModelFile read_ply(const std::filesystem::path& path, const ModelFormat& format = {});

}  // namespace clerestory::io
