// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/model_file.h"

namespace clerestory::io {

/// Reads a Radiance scene and the files that it includes by !xform and !cat, whose transforms and arrays are evaluated here, in
/// double; file names are relative to the including file's folder, else to that of the first file. No program is ever run.
/// - Surfaces become polygons (io/radiance_shapes.h). Instances, antimatter and mist are left out with a notice; so are distant sources
///   and skies, since the study says what sky there is.
/// - Materials are told by their own formulas (io/radiance_materials.h), by the names of the modifiers.
/// - The part of a surface: its file's name, or the name that !xform -n gives to the included file, those of outer files in front; in the
///   first file what stands before the last dot of the identifier.
/// - Radiance has no unit: unless told, it is guessed from the size.
/// Throws InputError with file and line for other commands, included files that are not there or include themselves, more than
/// kMostRadianceCopies included copies, 10 million primitives or 5 million polygons, a scene without surfaces, and where
/// read_radiance_file() does.
ModelFile read_radiance(const std::filesystem::path& path, const ModelFormat& format = {});

}  // namespace clerestory::io
