// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lighting/results.h"
#include "lighting/task_areas.h"

namespace clerestory::lighting {

/// The observers of a study and of its placed tasks, in that order; model coordinates.
std::vector<Observer> all_observers(const Study& study, const std::vector<PlacedTask>& tasks);

/// Judges the tasks of a study by the grids and observers of its results.
/// @param results  whose grids bear the names of the tasks' areas
std::vector<TaskResult> judge_tasks(const Study& study, const Scene& scene, const std::vector<PlacedTask>& tasks,
                                    const Results& results);

}  // namespace clerestory::lighting
