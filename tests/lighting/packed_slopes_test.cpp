// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/packed_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace clerestory::lighting {
namespace {

TEST(PackedSlopes, NumbersAreRightToOneIn2048) {
  for (float x = 0x1p-17F; x < 0x1p14F; x *= 1.01F) {
    EXPECT_NEAR(Packed(x).value(), x, x / 2048.0);
    EXPECT_EQ(Packed(-x).value(), -Packed(x).value());
  }
}

TEST(PackedSlopes, WhatIsPackedTwiceDoesNotChange) {
  for (std::uint32_t bits = 0x400; bits < 0x8000; ++bits) {
    const auto packed = Packed::of_bits(static_cast<std::uint16_t>(bits));
    EXPECT_EQ(Packed(packed.value()), packed);
  }
}

TEST(PackedSlopes, PowersOfTwoAndThreeHalvesOfThemAreExact) {
  for (int e = -17; e < 14; ++e) {
    EXPECT_EQ(Packed(std::ldexp(1.0F, e)).value(), std::ldexp(1.0F, e));
    EXPECT_EQ(Packed(std::ldexp(-1.5F, e)).value(), std::ldexp(-1.5F, e));
  }
}

TEST(PackedSlopes, TooSmallIsZeroAndTooLargeTheLargest) {
  EXPECT_EQ(Packed(0.0F).value(), 0.0F);
  EXPECT_EQ(Packed(0x1p-18F).value(), 0.0F);
  EXPECT_EQ(Packed(-1e-30F).value(), 0.0F);
  EXPECT_EQ(Packed(1e9F).value(), 0x1.FFCp13F);
  EXPECT_EQ(Packed(-std::numeric_limits<float>::infinity()).value(), -0x1.FFCp13F);
}

}  // namespace
}  // namespace clerestory::lighting
