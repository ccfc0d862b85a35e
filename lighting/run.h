// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/limits.h"
#include "lighting/results.h"
#include "lighting/study.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// Answers a study: cleans the model, meshes it, solves for the radiosity, and evaluates the grids.
/// Deterministic: the same bits whatever the number of threads, unless it is stopped. Where a limit is met, or the progress says that it
/// should finish, the answer is what can be had until then, its errors as they are and Results::stopped saying so.
/// Throws InputError (an empty grid, a reflectance of one or more, nothing left of the model …); before there is anything to show,
/// LimitReached, Interrupted, and MachineError for the machine's memory.
Results run(const Study& study, Progress& progress, const Limits& limits = {});

/// Answers the grids of a study from a solution that was stored. The study may differ in its grids, and in the accuracy that they are asked
/// for, without solving; in reflectances, sky and dimming, and in its columns, by solving on the stored links. The surfaces of the results are empty. Grids that the solved study had as well, in the same place of
/// the list, come out the same to the bit where nothing was solved. Throws as run(), and InputError where the solution is of another study.
Results sense(const Study& study, const StoredSolution& stored, Progress& progress, const Limits& limits = {});

/// Sets how many threads all of the program uses; 0 takes every core. Call before run().
void set_threads(int threads);

}  // namespace clerestory::lighting
