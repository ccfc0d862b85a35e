// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/direct_light.h"
#include "lighting/sky.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// What nodes of a solution receive straight from a sun.
struct CastSun {
  std::vector<GroupDirect> direct;
  std::vector<GroupError> errors;  ///< rays' noise, and what lines miss at the edges of the light
};

/// Casts a sun's rays on a solution as it stands: nodes that it lights everywhere or nowhere are taken whole, others by their elements. Makes
/// no new elements: where one is too coarse for the edge of a sun patch, its error says so.
/// Precondition: the scene has light from outdoors.
/// @param accuracy  rays' noise is brought to about this share of the sun's light on a node
/// @param group     that the light belongs to
CastSun cast_sun(const Solution& solution, const Sun& sun, std::uint32_t group, double accuracy, std::uint64_t seed);

}  // namespace clerestory::lighting
