// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/channel_solver.h"
#include "lighting/gather.h"
#include "lighting/results.h"

namespace clerestory::lighting {

/// Illuminance at sensors by each source group, by the rays with which all light was gathered, cast once more. Where all light has been cut
/// off at zero, so is that of the groups: they add up to it.
/// Errors: sampling by the spread of the rays' replicates, a group each; what the solution's errors make is independent from ray to ray
/// and link to link, so that its variance is shared out as the light is (docs/theory/channels.md).
/// @param gathered  of the same sensors and seed
std::vector<GroupColumn> gather_groups(const Solution& solution, const GroupRadiosity& radiosity,
                                       const Gathered& gathered, const SensorSet& sensors, std::uint64_t seed);

}  // namespace clerestory::lighting
