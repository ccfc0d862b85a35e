// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lighting/scene.h"
#include "mesh/geometry.h"
#include "mesh/ids.h"

namespace clerestory::lighting {

/// The random walks of one sensor, backwards along the light. They know the scene alone, and so tell which surfaces matter before there are
/// any elements.
struct SensorWalk {
  /// Where a walk met a surface that takes part in the solution.
  struct End {
    mesh::FaceSide side;
    std::uint32_t region = 0;  ///< of the face
    mesh::Point at;
    float weight = 0.0F;  ///< share of what the surface sends out there that comes to the sensor, over π and per area
  };

  std::size_t sensor = 0;  ///< its number among all
  std::vector<End> ends;
  double lux = 0.0;  ///< illuminance of the sensor as the walks see it, up to their last bounce
};

/// Walks from sensors that are spread evenly over the list of all of them; empty where there are none.
/// @param positions, normals  sensors, local coordinates
std::vector<SensorWalk> walk_from_sensors(const Scene& scene, std::span<const mesh::Point> positions,
                                          std::span<const mesh::Vector> normals, std::uint64_t seed);

/// [sides] non-zero where some walk ended, so that light from there is likely to come to the sensors; without walks everywhere.
std::vector<std::uint8_t> sides_reached(const Scene& scene, const std::vector<SensorWalk>& walks);

}  // namespace clerestory::lighting
