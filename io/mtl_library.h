// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/mtl.h"

namespace clerestory::io {

/// A mtllib line of a model.
struct MtlReference {
  std::string names;  ///< all that follows the keyword
  std::uint64_t line = 0;
};

/// The materials of all MTL files of a model.
struct MtlLibrary {
  std::vector<SourceMaterial>
      materials;  ///< by name in order of first definition; of two with one name the later counts
  std::vector<std::filesystem::path> files;
  std::vector<std::string> notices;  ///< one sentence each
};

/// Reads what the mtllib lines of a model name, relative to the model's folder. A line may name several files, and files with
/// spaces, escaped or not; a path that is not there (as from another machine) is looked for beside the model by its last part; where nothing
/// is found, the MTL with the name of the model stands in, with a notice.
/// Throws InputError where none of the files of a line is there, and where read_mtl() does.
MtlLibrary read_mtl_library(const std::filesystem::path& model, const std::vector<MtlReference>& references);

}  // namespace clerestory::io
