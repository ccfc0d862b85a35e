// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/mtl.h"
#include "io/units.h"
#include "mesh/model.h"

namespace clerestory::io {

/// What a model file may leave open.
struct ModelFormat {
  std::optional<LengthUnit> unit;  ///< none: what the file's header says, else guessed from the size
  UpAxis up = UpAxis::kZ;
};

/// A Wavefront OBJ file with its MTL files.
struct ObjFile {
  mesh::Model model;                   ///< metres, z up; only vertices that a face uses
  std::vector<MtlMaterial> materials;  ///< one a model material, in the model's order
  /// Names that the MTL files define and no face uses.
  std::vector<std::string> unused_materials;
  LengthUnit unit = LengthUnit::kMetre;      ///< that was taken
  std::vector<std::string> notices;          ///< how the unit was found, what was left out; one sentence each
  std::vector<std::filesystem::path> files;  ///< that were read, the OBJ first
};

/// Reads polygons in double precision, each number to the nearest double. The latest `o` or `g` names the part, `usemtl` the
/// material ("default" where none is named); points, lines, texture coordinates and normals are passed over.
/// Throws InputError with file and line for: a face with under 3 corners or a corner that does not exist, a coordinate that is no
/// finite number, an incomplete line, an MTL file that is not there, a file without faces, and where read_mtl() does.
/// Source: Wavefront, Object Files, appendix B1, 1995.
ObjFile read_obj(const std::filesystem::path& path, const ModelFormat& format = {});

}  // namespace clerestory::io
