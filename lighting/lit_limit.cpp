// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/lit_limit.h"

#include <algorithm>
#include <cstddef>

#include "lighting/parallel.h"

namespace clerestory::lighting {

namespace {

constexpr std::size_t kBatch = 1024;  ///< places between two signs of life

}  // namespace

std::vector<std::optional<LocalPass::Light>> light_limit(const LocalPass& local, std::span<const LimitPlace> places,
                                                         Progress& progress) {
  std::vector<std::optional<LocalPass::Light>> light(places.size());
  for (std::size_t first = 0; first < places.size(); first += kBatch) {
    const std::size_t end = std::min(first + kBatch, places.size());
    parallel_for(
        end - first,
        [&](std::size_t k) {
          const LimitPlace& place = places[first + k];
          light[first + k] = local.at_limit(place.element, place.inside, place.limit);
        },
        16);
    progress.advance(static_cast<double>(end) / static_cast<double>(places.size()));
  }
  return light;
}

}  // namespace clerestory::lighting
