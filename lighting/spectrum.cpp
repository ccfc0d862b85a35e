// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/spectrum.h"

#include <cassert>

namespace clerestory::lighting {

namespace {

template <class Value>
double weighted_sum(std::span<const Value> spectrum, std::span<const float> weights) {
  if (spectrum.size() == 1) return spectrum[0];
  assert(spectrum.size() == weights.size());
  double sum = 0.0;
  for (std::size_t band = 0; band < spectrum.size(); ++band)
    sum += static_cast<double>(weights[band]) * static_cast<double>(spectrum[band]);
  return sum;
}

}  // namespace

std::vector<float> luminance_weights(std::size_t bands) {
  if (bands == kPrimaries) return {0.265F, 0.670F, 0.065F};
  return std::vector<float>(bands, 1.0F / static_cast<float>(bands));
}

float luminance(std::span<const float> spectrum, std::span<const float> weights) {
  return static_cast<float>(weighted_sum(spectrum, weights));
}

double luminance(std::span<const double> spectrum, std::span<const float> weights) {
  return weighted_sum(spectrum, weights);
}

}  // namespace clerestory::lighting
