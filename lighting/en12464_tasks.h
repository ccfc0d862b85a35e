// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace clerestory::lighting {

/// What EN 12464-1 asks of a visual task and of the space it is done in.
struct TaskRequirements {
  std::string task;              ///< in words, with its reference
  double illuminance_lux = 0.0;  ///< maintained mean on the task area
  double uniformity = 0.0;       ///< minimum by mean on the task area
  double ugr = 0.0;              ///< the most; 0: none is asked
  double cylindrical_lux = 0.0;  ///< maintained mean in the activity space; 0: none is asked
  double walls_lux = 0.0;        ///< maintained mean; 0: none is asked
  double ceiling_lux = 0.0;      ///< maintained mean; 0: none is asked
};

/// A task of the built-in list.
struct StandardTask {
  std::string_view word;  ///< in a study
  std::string_view what;  ///< as people say
  double illuminance_lux;
  double uniformity;
  double ugr;
  double cylindrical_lux;
  double walls_lux;
  double ceiling_lux;
};

/// Common tasks with their required values. These are figures as commonly quoted from EN 12464-1:2021, whose text is not free: for a contract look
/// them up there, and state others in the study where they differ.
std::span<const StandardTask> standard_tasks();

/// The task of that word, nullptr if there is none.
const StandardTask* find_task(std::string_view word);

/// What it asks.
TaskRequirements requirements_of(const StandardTask& task);

}  // namespace clerestory::lighting
