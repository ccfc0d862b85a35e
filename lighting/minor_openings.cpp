// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/minor_openings.h"

#include <algorithm>
#include <cmath>

namespace clerestory::lighting {

namespace {

/// The probability of each to be drawn: by size, and no more than 1, so that all together are as many as are wanted.
std::vector<double> probabilities(std::span<const double> sizes, std::size_t most) {
  std::vector<double> chance(sizes.size(), 0.0);
  std::size_t certain = 0;
  for (bool settled = false; !settled;) {
    settled = true;
    double rest = 0.0;
    for (std::size_t i = 0; i < sizes.size(); ++i) rest += chance[i] < 1.0 ? sizes[i] : 0.0;
    const double scale = static_cast<double>(most - certain) / rest;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (chance[i] >= 1.0) continue;
      chance[i] = std::min(1.0, scale * sizes[i]);
      if (chance[i] < 1.0) continue;
      ++certain;
      settled = false;
    }
  }
  return chance;
}

}  // namespace

void draw_openings(std::span<const double> sizes, std::size_t most, double start, std::vector<MinorOpening>& openings) {
  if (openings.size() <= most) return;
  const std::vector<double> chance = probabilities(sizes, most);
  std::vector<MinorOpening> drawn;
  double passed = start;
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const double before = std::floor(passed);
    passed += chance[i];
    // Sums of many probabilities round: those that are certain must not be lost by it.
    if (chance[i] < 1.0 && std::floor(passed) <= before) continue;
    drawn.push_back({openings[i].opening, openings[i].weight / static_cast<float>(chance[i])});
  }
  openings = std::move(drawn);
}

}  // namespace clerestory::lighting
