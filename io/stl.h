// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "io/model_file.h"

namespace clerestory::io {

/// Whether the first bytes of a file can only be those of a text STL. Binary ones begin with anything.
bool is_text_stl(std::string_view head);

/// Reads STL, text or binary: binary where the size is what the count of triangles asks for, else text where the file begins as one, whatever
/// word the header begins with. Solids are parts by their names (binary: by the file's), normals and colours are passed over, facets that
/// share coordinates share vertices.
/// Throws InputError with line or byte for: a file that is cut off, a word that has no place in the grammar, a coordinate that is no finite
/// number, a facet with under 3 corners, and a file without facets.
/// Source: 3D Systems, StereoLithography Interface Specification, 1989.
ModelFile read_stl(const std::filesystem::path& path, const ModelFormat& format = {});

}  // namespace clerestory::io
