// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/channels.h"
#include "lighting/receiver.h"
#include "lighting/sensor_rays.h"
#include "lighting/solution.h"
#include "lighting/solution_errors.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// How a sensor's light was found: its rays can be cast again.
struct SensorRecord {
  std::vector<SensorPart> parts;
  std::vector<GroupLight> exact;    ///< what took no rays: proven views of emitters, point sources
  float discretisation_lux = 0.0F;  ///< error that the solution's own errors make
};

/// Illuminance at sensors with its standard uncertainty (k = 1) [lux].
struct Gathered {
  std::vector<float> illuminance_lux;
  std::vector<float> error_lux;
  /// Of illuminance_lux what surfaces send that is not their own light, and the sky by unmarked holes; and its error.
  std::vector<float> indirect_lux;
  std::vector<float> indirect_error_lux;
  std::vector<SensorRecord> records;  ///< where groups are told apart
};

/// Evaluates the solution at sensors: emitting surfaces and point sources straight, openings by solid angle, all else over the
/// cosine-weighted hemisphere, each path once. Samples until the sampling error of every sensor is under its share of the
/// accuracy, a cap on rays is met, or the progress says that it should finish; what remains stands in error_lux.
/// @param errors  of the solution
Gathered gather(const Solution& solution, const SolutionErrors& errors, const SensorSet& sensors, double accuracy,
                std::uint64_t seed, Progress& progress);

}  // namespace clerestory::lighting
