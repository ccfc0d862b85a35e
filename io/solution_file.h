// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lighting/stored_solution.h"
#include "lighting/study.h"

namespace clerestory::io {

/// A stored solution, and the study that it belongs to.
struct SolutionFile {
  std::filesystem::path study;  ///< absolute
  lighting::Study::Kind kind = lighting::Study::Kind::kDaylight;
  std::vector<std::string> set;  ///< overrides of the study's keys
  lighting::StoredSolution solution;
};

/// Writes an HDF5 file (docs/results.md has its layout). Throws WriteError.
void write_solution(const std::filesystem::path& file, const SolutionFile& solution);

/// Throws InputError for a file that is missing, none of ours, cut off, damaged, or of another version of the program.
SolutionFile read_solution(const std::filesystem::path& file);

}  // namespace clerestory::io
