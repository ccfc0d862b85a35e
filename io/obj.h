// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/model_file.h"

namespace clerestory::io {

/// Reads polygons in double precision, each number to the nearest double. The latest `o` or `g` names the part, `usemtl` the
/// material ("default" where none is named); points, lines, texture coordinates and normals are passed over.
/// OpenSubdiv's `t` lines become the model's subdivision tags (io/obj_tags.h).
/// Throws InputError with file and line for: a face with under 3 corners or a corner that does not exist, a coordinate that is no
/// finite number, an incomplete line or tag, an MTL file that is not there, a file without faces, and where read_mtl() does.
/// Source: Wavefront, Object Files, appendix B1, 1995.
ModelFile read_obj(const std::filesystem::path& path, const ModelFormat& format = {});

}  // namespace clerestory::io
