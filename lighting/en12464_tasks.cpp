// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/en12464_tasks.h"

#include <algorithm>
#include <array>

namespace clerestory::lighting {

namespace {

/// Circulation, rest rooms, offices and schools, in the standard's order of tables.
/// Source: EN 12464-1:2021, tables 9 (circulation), 10 (rest and sanitation), 34 (offices) and 44 (schools): required values.
constexpr std::array kTasks{
    StandardTask{"corridor", "corridors and circulation areas", 100, 0.40, 28, 50, 50, 30},
    StandardTask{"stairs", "stairs, escalators, travelators", 100, 0.40, 25, 50, 50, 30},
    StandardTask{"canteen", "canteens, pantries", 200, 0.40, 22, 75, 75, 50},
    StandardTask{"washroom", "cloakrooms, washrooms, bathrooms, toilets", 200, 0.40, 25, 75, 75, 50},
    StandardTask{"office-filing", "offices: filing, copying", 300, 0.40, 19, 100, 100, 75},
    StandardTask{"office-writing", "offices: writing, typing, reading, data processing", 500, 0.60, 19, 150, 150, 100},
    StandardTask{"office-drawing", "offices: technical drawing", 750, 0.70, 16, 150, 150, 100},
    StandardTask{"office-cad", "offices: CAD workstations", 500, 0.60, 19, 150, 150, 100},
    StandardTask{"meeting", "conference and meeting rooms", 500, 0.60, 19, 150, 150, 100},
    StandardTask{"reception", "reception desks", 300, 0.60, 22, 100, 100, 75},
    StandardTask{"archive", "archives", 200, 0.40, 25, 75, 75, 50},
    StandardTask{"classroom", "classrooms: general activities", 500, 0.60, 19, 150, 150, 100},
    StandardTask{"lecture-hall", "auditoriums, lecture halls", 500, 0.60, 19, 150, 150, 50},
};

}  // namespace

std::span<const StandardTask> standard_tasks() { return kTasks; }

const StandardTask* find_task(std::string_view word) {
  const auto* const at = std::ranges::find(kTasks, word, &StandardTask::word);
  return at == kTasks.end() ? nullptr : at;
}

TaskRequirements requirements_of(const StandardTask& task) {
  return {.task = std::string(task.what),
          .illuminance_lux = task.illuminance_lux,
          .uniformity = task.uniformity,
          .ugr = task.ugr,
          .cylindrical_lux = task.cylindrical_lux,
          .walls_lux = task.walls_lux,
          .ceiling_lux = task.ceiling_lux};
}

}  // namespace clerestory::lighting
