// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lighting/grids.h"
#include "lighting/scene.h"

namespace clerestory::lighting {

/// Where EN 12464-1 wants to know the light.
enum class TaskArea : std::uint8_t {
  kTask,
  kSurrounding,  ///< a band of 0.5 m about the task area
  kBackground,   ///< 3 m beyond that, within the room
  kActivity,     ///< at the height of the eyes: cylindrical illuminance and modelling
  kWalls,
  kCeiling,
};
inline constexpr std::size_t kTaskAreas = 6;

/// The sensors of a task in one room.
struct PlacedTask {
  std::size_t request = 0;  ///< of the study's tasks
  std::string name;         ///< with the room's where several rooms have the task
  std::uint32_t room = 0;
  std::array<std::optional<NamedSensors>, kTaskAreas> areas;  ///< none where there is no such area
  std::vector<Observer> observers;                            ///< model coordinates; the study's own are not repeated

  [[nodiscard]] const std::optional<NamedSensors>& area(TaskArea a) const { return areas[static_cast<std::size_t>(a)]; }
};

/// Where the tasks of a study are looked at, local coordinates, room by room: grids by the standard's rule (grid_layout.h); along the walls a
/// strip is left out (the automatic margin of grids). Walls are upright surfaces that reach up to within 0.3 m of the room's top, ceilings
/// those that look down 2 m or more above its floor, of 1 m² at least, glass left out. Where the study has no observer in a room, four stand at the middle of its
/// sides and look across.
/// @param taken  names of other grids, in small letters
/// Throws InputError where no room fits.
/// Source: EN 12464-1:2021, 4.4 and 5.3.
std::vector<PlacedTask> place_tasks(const Study& study, const Scene& scene, std::set<std::string> taken);

}  // namespace clerestory::lighting
