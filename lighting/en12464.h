// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "lighting/results.h"
#include "lighting/task_areas.h"

namespace clerestory::lighting {

/// A figure against what is asked, both told as they are: passed or failed where it is farther from the limit than twice its standard
/// uncertainty, else undecided.
Criterion::Verdict verdict_of(const Criterion& criterion);

/// What is judged of a task in one room.
struct TaskFindings {
  std::array<const GridResult*, kTaskAreas> areas{};  ///< null where there is none
  std::vector<const ObserverResult*> observers;
  bool whole_room = false;  ///< the task area is all of the room
  bool with_daylight = false;

  [[nodiscard]] const GridResult* area(TaskArea a) const { return areas[static_cast<std::size_t>(a)]; }
};

/// Judges a task: maintained mean and uniformity of the task area; of surrounding and background what follows from it; cylindrical
/// illuminance, walls and ceiling; UGR of the worst observer. The error of a mean is the mean of its sensors' errors, as if all went the same way.
/// The caller adds the task's name, room, grids and observers.
/// Source: EN 12464-1:2021, 4.3 (table 1), 4.4, 4.5, 5.3.
TaskResult judge(const TaskRequirements& required, const TaskFindings& findings);

}  // namespace clerestory::lighting
