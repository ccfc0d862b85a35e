// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>

#include "io/study_file.h"
#include "lighting/limits.h"
#include "lighting/results.h"
#include "lighting/study.h"
#include "mesh/progress.h"
#include "tools/options.h"

namespace clerestory::tools {

/// What is to be answered, and how.
struct Question {
  std::filesystem::path file;  ///< the study's, or the model's
  io::StudyInput input;
  std::function<lighting::Results(Progress&, const lighting::Limits&)> compute;
  bool from_stored = false;  ///< by a solution that a run has kept
};

/// The way that every subcommand with results takes: reads what is asked, makes sure that the results can be written, computes, writes
/// and prints them. A run that fails leaves that word in the folder of the results; one that is refused
/// or interrupted leaves the folder as it was. Returns the exit status.
/// Throws InputError, MachineError, Interrupted, and what the standard library throws.
int answer(const Options& options, const std::function<Question()>& read);

/// The same for a study that is to be run.
int answer(lighting::Study::Kind kind, const Options& options);

}  // namespace clerestory::tools
