// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/model_report.h"
#include "mesh/clean.h"
#include "mesh/progress.h"

namespace clerestory::io {

// A cleaned model and what stands beside it: FILE.report.txt, FILE.report.json, FILE.defects.vtp, and the files that its format needs.
// FILE itself is replaced where it is there. Of the others only those are, that the FILE.report.json there lists as ours.

/// Makes sure that a cleaned model can be written there, before long work. Changes nothing.
/// Throws InputError: no format for the extension, one of the files that were read in its place, a folder that is not there, a file in the
/// way that is not ours; MachineError where the folder cannot be written to.
void check_cleaned_model(const std::filesystem::path& file, const StudyInput& input);

/// Writes a cleaned model in the format of the file's extension, in metres with z up, and its report, all to a hidden folder first; then
/// moves them to their places.
/// @param report  of that surface; receives the names of the files
/// Throws as check_cleaned_model(), and Interrupted; what was there stays then.
void write_cleaned_model(const std::filesystem::path& file, mesh::CleanSurface surface, ModelReport& report,
                         Progress& progress);

}  // namespace clerestory::io
