// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/observers.h"
#include "lighting/results.h"
#include "lighting/scene.h"
#include "lighting/study.h"
#include "lighting/task_areas.h"
#include "mesh/geometry.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// All points whose light a study asks for: those that light is told at, and those that importance starts from. Local coordinates [m].
struct AllSensors {
  std::vector<mesh::Point> positions;
  std::vector<mesh::Vector> normals;
  std::vector<std::uint32_t> grids;  ///< number of each sensor's grid
  std::vector<PlacedTask> tasks;
  std::vector<Observer> observers;  ///< model coordinates
};

/// Places the sensors of all grids, of tasks and of observers. Grids become results, without light as yet.
/// @param scene  hears of what was noticed
/// Throws InputError as place_sensors() and place_tasks() do.
AllSensors place_all_sensors(const Study& study, Scene& scene, Results& results, Progress& progress);

}  // namespace clerestory::lighting
