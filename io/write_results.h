// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/result_context.h"
#include "io/summary.h"
#include "lighting/results.h"
#include "lighting/study.h"
#include "mesh/progress.h"

namespace clerestory::io {

/// The names that the files of a study's results have, for check_result_folder(); not those of leaks, and of grids named
/// after rooms, which only the run finds. `file` is the study's, for messages.
/// Throws InputError for grid names that no file can have, and for grids that would share a file.
std::vector<std::string> result_names(const lighting::Study& study, const std::filesystem::path& file);

/// Writes the results into the folder: summary.json; a table, the polygons and a map of each grid; the surfaces; and
/// the collection of them (docs/results.md). All or nothing: see ResultFolder. Adds the phase "writing" and the list
/// of files to the figures. Returns the text of summary.json.
/// Throws MachineError, InputError when a file of the user's is in the way by now, and Interrupted.
std::string write_results(const std::filesystem::path& folder, const lighting::Results& results,
                          const ResultContext& context, RunFigures figures, Progress& progress);

/// Records in the folder that a run failed, and why; older results of ours go to `previous/`. Throws as
/// write_results().
void write_failure(const std::filesystem::path& folder, const ResultContext& context, const std::string& why);

}  // namespace clerestory::io
