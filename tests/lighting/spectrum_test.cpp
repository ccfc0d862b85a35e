// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/spectrum.h"

#include <gtest/gtest.h>

#include <numeric>

namespace clerestory::lighting {
namespace {

TEST(Spectrum, WeightsSumToOneForAnyCountOfBands) {
  for (const std::size_t bands : {1U, 3U, 9U, 81U}) {
    const auto weights = luminance_weights(bands);
    EXPECT_EQ(weights.size(), bands);
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0, 1e-6);
  }
}

TEST(Spectrum, NeutralStimuliHaveTheirOwnValueAsLuminance) {
  for (const std::size_t bands : {1U, 3U, 9U})
    EXPECT_NEAR(luminance(Spectrum(bands, 0.4F), luminance_weights(bands)), 0.4F, 1e-6F);
}

TEST(Spectrum, GreenCountsMost) {
  const auto weights = luminance_weights(3);
  EXPECT_FLOAT_EQ(luminance(Spectrum{0.0F, 1.0F, 0.0F}, weights), 0.670F);
  EXPECT_FLOAT_EQ(luminance(Spectrum{1.0F, 0.0F, 0.0F}, weights), 0.265F);
}

TEST(Spectrum, OneBandStandsForItself) { EXPECT_EQ(luminance(Spectrum{0.7F}, luminance_weights(3)), 0.7F); }

}  // namespace
}  // namespace clerestory::lighting
