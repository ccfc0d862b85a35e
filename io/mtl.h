// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "io/source_material.h"

namespace clerestory::io {

/// Reads the materials of an MTL file, in its order; of two with one name the later one counts.
/// Throws InputError with file and line for numbers that are none, and for colours below zero.
/// Source: Wavefront, Object Files, appendix B (MTL), 1995.
std::vector<SourceMaterial> read_mtl(const std::filesystem::path& path);

}  // namespace clerestory::io
