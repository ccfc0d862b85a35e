// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "io/model_file.h"

namespace clerestory::io {

/// Whether the first bytes of a file can only be those of a DXF.
bool is_dxf(std::string_view head);

/// Reads the surfaces of a text DXF, as read_dxf_drawing() does, with blocks put where they are inserted. The layer names part and material;
/// layers that are off or frozen are left out and named. Solids (3DSOLID, BODY, REGION, SURFACE), curves, and lines and polylines with a
/// thickness are left out and counted.
/// Throws InputError where read_dxf_drawing() does, for a block that holds itself, for inserts of more faces than any building has, and for a
/// drawing without faces.
ModelFile read_dxf(const std::filesystem::path& path, const ModelFormat& format = {});

}  // namespace clerestory::io
