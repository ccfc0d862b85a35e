// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace clerestory::lighting {

/// A value per band, photometrically normalised: neutral stimuli have the same number in every band, and
/// luminance is the sum of weight x value (docs/theory/transport.md). One band is grey.
using Spectrum = std::vector<float>;

/// Red, green and blue.
constexpr std::size_t kPrimaries = 3;

/// Weights of the bands in luminance: {1} for one band, Radiance's primaries (0.265, 0.670, 0.065) for three,
/// equal shares for any other count.
std::vector<float> luminance_weights(std::size_t bands);

/// Sum of weight x value; a spectrum of one band stands for itself whatever the count of weights.
float luminance(std::span<const float> spectrum, std::span<const float> weights);
double luminance(std::span<const double> spectrum, std::span<const float> weights);

}  // namespace clerestory::lighting
