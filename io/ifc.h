// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "io/model_file.h"

namespace clerestory::io {

/// Whether the first bytes of a file are those of a STEP file, as IFC files are.
bool is_ifc(std::string_view head);

/// Reads an IFC2x3 or IFC4 building: openings cut from walls and slabs, panes of windows as materials of clear glass, spaces as
/// ModelSpace; parts are "Level 1/Wall name", materials those of outer layers, else of styles, else of elements. In a child process.
/// Throws InputError with file and line for other schemas, for what is no IFC, and where no element has a body.
ModelFile read_ifc(const std::filesystem::path& path, const ModelFormat& format);

}  // namespace clerestory::io
