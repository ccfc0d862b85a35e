// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/task_results.h"

#include <algorithm>

#include "lighting/en12464.h"
#include "lighting/installed.h"

namespace clerestory::lighting {

namespace {

const GridResult* grid_of(const std::optional<NamedSensors>& area, const Results& results) {
  if (!area) return nullptr;
  const auto at = std::ranges::find(results.grids, area->name, &GridResult::name);
  return at == results.grids.end() ? nullptr : &*at;
}

TaskFindings findings_of(const Study& study, const Scene& scene, const PlacedTask& task, const Results& results) {
  TaskFindings findings;
  for (std::size_t a = 0; a < kTaskAreas; ++a) findings.areas[a] = grid_of(task.areas[a], results);
  for (const ObserverResult& observer : results.observers)
    if (observer.room == task.room) findings.observers.push_back(&observer);
  findings.whole_room = !study.tasks[task.request].rectangle;
  findings.with_daylight = scene.has_sky();
  return findings;
}

}  // namespace

std::vector<Observer> all_observers(const Study& study, const std::vector<PlacedTask>& tasks) {
  std::vector<Observer> observers = study.observers;
  for (const PlacedTask& task : tasks) observers.insert(observers.end(), task.observers.begin(), task.observers.end());
  return observers;
}

std::vector<TaskResult> judge_tasks(const Study& study, const Scene& scene, const std::vector<PlacedTask>& tasks,
                                    const Results& results) {
  const std::vector<RoomPower> powers = room_powers(scene);
  std::vector<TaskResult> judged;
  for (const PlacedTask& task : tasks) {
    const TaskFindings findings = findings_of(study, scene, task, results);
    TaskResult result = judge(study.tasks[task.request].required, findings);
    result.name = task.name;
    result.room = scene.rooms.rooms[task.room].name;
    for (const GridResult* grid : findings.areas)
      if (grid != nullptr) result.grids.push_back(grid->name);
    for (const ObserverResult* observer : findings.observers) result.observers.push_back(observer->observer.name);
    const auto power = std::ranges::find(powers, task.room, &RoomPower::number);
    const GridResult* area = findings.area(TaskArea::kTask);
    if (power != powers.end() && area != nullptr && !findings.with_daylight && area->metrics.mean_lux > 0.0)
      result.power_w_m2_per_100_lux = 100.0 * power->per_area_w_m2 / area->metrics.mean_lux;
    judged.push_back(std::move(result));
  }
  return judged;
}

}  // namespace clerestory::lighting
