// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/all_sensors.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "lighting/grids.h"
#include "lighting/task_results.h"

namespace clerestory::lighting {

namespace {

void add(const Sensors& sensors, std::uint32_t grid, AllSensors& all) {
  all.positions.insert(all.positions.end(), sensors.positions.begin(), sensors.positions.end());
  all.normals.insert(all.normals.end(), sensors.normals.begin(), sensors.normals.end());
  all.grids.resize(all.positions.size(), grid);
}

/// Each cylinder as one plane along it, neighbours by the golden angle apart: all together look all round.
void add_cylinders(const Sensors& sensors, std::uint32_t grid, AllSensors& all) {
  constexpr double kGoldenAngle = 2.399963229728653;
  for (std::size_t i = 0; i < sensors.count(); ++i) {
    const double phi = kGoldenAngle * static_cast<double>(i);
    all.positions.push_back(sensors.positions[i]);
    all.normals.push_back({std::cos(phi), std::sin(phi), 0.0});
  }
  all.grids.resize(all.positions.size(), grid);
}

/// Makes a grid one of the results.
/// @param modelling  whether cylinders stand in its places too
void take(AllSensors& all, GridResult grid, bool modelling, Results& results) {
  const auto number = static_cast<std::uint32_t>(results.grids.size());
  if (!grid.sensors.cylinders) add(grid.sensors, number, all);
  if (grid.sensors.cylinders || modelling) add_cylinders(grid.sensors, number, all);
  if (modelling) grid.cylindrical_lux.resize(grid.sensors.count());
  results.grids.push_back(std::move(grid));
}

/// The grids of the study's tasks, and all observers.
void take_tasks(const Study& study, const Scene& scene, AllSensors& all, Results& results) {
  std::set<std::string> taken;
  for (const GridResult& grid : results.grids) taken.insert(lower(grid.name));
  all.tasks = place_tasks(study, scene, std::move(taken));
  for (const PlacedTask& task : all.tasks) {
    for (std::size_t a = 0; a < kTaskAreas; ++a) {
      if (!task.areas[a]) continue;
      GridResult grid;
      grid.name = task.areas[a]->name;
      grid.sensors = task.areas[a]->sensors;
      take(all, std::move(grid), static_cast<TaskArea>(a) == TaskArea::kActivity, results);
    }
  }
  all.observers = all_observers(study, all.tasks);
  for (const Observer& observer : all.observers) {
    all.positions.push_back(observer.eye - scene.faces.origin);
    all.normals.push_back(observer.look);
  }
  all.grids.resize(all.positions.size(), static_cast<std::uint32_t>(results.grids.size()));
}

}  // namespace

AllSensors place_all_sensors(const Study& study, Scene& scene, Results& results, Progress& progress) {
  AllSensors all;
  double placed_requests = 0.0;
  const SensorPlaces places{scene.faces, *scene.rays, scene.reachable_triangles, scene.rooms};
  for (const GridRequest& request : study.grids) {
    for (NamedSensors& placed : place_sensors(request, places, scene.notices)) {
      GridResult grid;
      grid.name = std::move(placed.name);
      grid.sensors = std::move(placed.sensors);
      grid.direction = request.direction;
      take(all, std::move(grid), request.modelling, results);
    }
    progress.advance(++placed_requests / static_cast<double>(study.grids.size()));
  }
  take_tasks(study, scene, all, results);
  return all;
}

}  // namespace clerestory::lighting
