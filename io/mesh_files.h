// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/result_context.h"
#include "lighting/element_mesh.h"
#include "mesh/progress.h"

namespace clerestory::io {

/// The names of the files that write_mesh() may write.
std::vector<std::string> mesh_file_names();

/// Writes the element mesh of a study to a folder: `elements.vtp` (but where only the lines were asked for), `discontinuities.vtp` and
/// `summary.json`, all or none of them, as write_results() does.
/// @return the text of the summary
/// Throws InputError when a name is taken by a file that is not ours, MachineError when the files cannot be written whole.
std::string write_mesh(const std::filesystem::path& folder, const lighting::MeshedStudy& meshed,
                       const ResultContext& context, Progress& progress);

/// The summary for a reader at a terminal.
std::string mesh_report(const lighting::MeshedStudy& meshed, const std::filesystem::path& folder);

}  // namespace clerestory::io
