// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/study.h"
#include "tools/options.h"

namespace clerestory::tools {

/// The way that every subcommand with a study takes: reads it, makes sure that the results can be written, runs it,
/// writes and prints the results. A run that fails leaves that word in the folder of the results; one that is refused
/// or interrupted leaves the folder as it was. Returns the exit status.
/// Throws InputError, MachineError, Interrupted, and what the standard library throws.
int answer(lighting::Study::Kind kind, const Options& options);

}  // namespace clerestory::tools
