// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lighting/solution.h"
#include "lighting/solution_errors.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// Some sensors of each grid, by which a solution is judged while it is still refined: much cheaper than to gather at all sensors, and as
/// good for telling whether that would pay already.
class SensorProbe {
 public:
  /// @param positions  of all sensors, local coordinates [m]
  /// @param normals    unit length
  /// @param grids      the number of each sensor's grid
  SensorProbe(const Scene& scene, std::span<const mesh::Point> positions, std::span<const mesh::Vector> normals,
              std::span<const std::uint32_t> grids, std::uint64_t seed);

  /// What errors of the solution make at the sensors: the root mean square over those of a grid, each as a share of its light [0 … 1], of the
  /// grid where that is most; 0 without sensors.
  [[nodiscard]] double discretisation(const Solution& solution, const SolutionErrors& errors) const;

 private:
  struct Sensor {
    mesh::Point at;  ///< off what it may stand on
    mesh::Vector normal;
    std::uint64_t seed = 0;
  };
  struct Seen {
    double lux = 0.0;
    double error_lux = 0.0;
  };

  [[nodiscard]] static Seen look(const Solution& solution, const SolutionErrors& errors, const Sensor& sensor);

  std::vector<std::vector<Sensor>> grids_;
};

}  // namespace clerestory::lighting
