// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "lighting/replicates.h"
#include "lighting/sampling.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

struct SampledMean : ReplicateMean {
  std::uint32_t samples = 0;  ///< of all sets
};

/// The mean of a function of points, by independently scrambled sets of them, each of which is doubled until it is enough.
/// @param first, most  points a set
/// @param sample       (points, number) → value
/// @param enough       (mean so far, points a set) → whether to stop before the most
template <class Sample, class Enough>
SampledMean sampled_mean(std::uint64_t key, std::uint32_t first, std::uint32_t most, Sample sample, Enough enough) {
  constexpr std::uint32_t kSets = 8;
  std::array<double, kSets> sums{};
  std::uint32_t begin = 0;
  for (std::uint32_t count = first;; count *= 2) {
    for (std::uint32_t s = 0; s < kSets; ++s) {
      const SobolPoints points(mesh::hash(key, s));
      for (std::uint32_t i = begin; i < count; ++i) sums[s] += sample(points, i);
    }
    begin = count;
    std::array<double, kSets> means{};
    for (std::uint32_t s = 0; s < kSets; ++s) means[s] = sums[s] / count;
    const ReplicateMean mean = mean_of_replicates(means);
    if (count >= most || enough(mean, count)) return {mean, kSets * count};
  }
}

}  // namespace clerestory::lighting
