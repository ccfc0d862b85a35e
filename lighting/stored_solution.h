// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lighting/energy_balance.h"
#include "lighting/scene_hash.h"

namespace clerestory::lighting {

class Solution;
class SolutionErrors;

/// A solution as it is kept: what its element tree has become, by numbers of nodes, and what its elements receive. The start of the tree
/// follows from the scene, which the hash holds fast.
struct StoredSolution {
  SceneHash scene;
  double accuracy = 0.0;  ///< asked for
  std::uint32_t channels = 1;
  std::uint32_t roots = 0;             ///< of the tree
  std::vector<std::uint32_t> divided;  ///< nodes, in the order in which they were
  std::vector<std::uint32_t> open;     ///< nodes whose children take part, in order
  std::vector<std::uint32_t> elements;
  std::vector<std::array<float, 3>>
      irradiance;                            ///< [elements × channels] value [lux] and slopes [lux/m], as LinearValue
  std::vector<float> misfit_lux;             ///< [elements] what a line misses elsewhere than in its middle
  std::vector<std::array<float, 8>> errors;  ///< [elements] samples of what the irradiance may be wrong by [lux]
  std::uint64_t seed = 0;                    ///< of these samples
  EnergyBalance energy;
  std::uint64_t links = 0;  ///< that it was made with
};

/// All but the energy balance and the number of links, which the solution does not know.
StoredSolution store(const Solution& solution, const SolutionErrors& errors, double accuracy);

/// Makes a fresh solution of the same scene what the stored one was, and gives its errors.
/// Throws InputError where the two do not fit, and says what has changed.
SolutionErrors restore(const StoredSolution& stored, Solution& solution);

}  // namespace clerestory::lighting
