// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/results.h"
#include "lighting/study.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// Answers a study: cleans the model, meshes it, solves for the radiosity, and evaluates the grids.
/// Deterministic: the same bits whatever the number of threads.
/// Throws InputError (an empty grid, a reflectance of one or more, nothing left of the model …) and Interrupted.
Results run(const Study& study, Progress& progress);

/// Sets how many threads all of the program uses; 0 takes every core. Call before run().
void set_threads(int threads);

}  // namespace clerestory::lighting
