// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/minor_openings.h"

#include <gtest/gtest.h>

namespace clerestory::lighting {
namespace {

std::vector<MinorOpening> numbered(std::size_t count) {
  std::vector<MinorOpening> openings;
  for (std::size_t i = 0; i < count; ++i) openings.push_back({static_cast<std::uint32_t>(i)});
  return openings;
}

TEST(MinorOpenings, FewAreAllKept) {
  std::vector<MinorOpening> openings = numbered(3);
  draw_openings(std::vector<double>{1.0, 2.0, 3.0}, 3, 0.5, openings);
  ASSERT_EQ(openings.size(), 3U);
  for (const MinorOpening& o : openings) EXPECT_EQ(o.weight, 1.0F);
}

TEST(MinorOpenings, WhatIsDrawnStandsForAllOnTheMean) {
  constexpr std::size_t kCount = 100;
  constexpr int kStarts = 10'000;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < kCount; ++i) sizes.push_back(1.0 / (1.0 + static_cast<double>(i * i)));
  std::vector<double> mean(kCount, 0.0);
  for (int s = 0; s < kStarts; ++s) {
    std::vector<MinorOpening> openings = numbered(kCount);
    draw_openings(sizes, 8, (s + 0.5) / kStarts, openings);
    EXPECT_NEAR(static_cast<double>(openings.size()), 8.0, 1.0);
    for (const MinorOpening& o : openings) mean[o.opening] += static_cast<double>(o.weight) / kStarts;
  }
  // The least likely are drawn some five times in all starts.
  for (std::size_t i = 0; i < kCount; ++i) EXPECT_NEAR(mean[i], 1.0, i < 30 ? 0.01 : 0.25) << i;
}

TEST(MinorOpenings, OneThatOutweighsAllOthersIsAlwaysDrawn) {
  std::vector<double> sizes(1000, 1e-3);
  sizes[500] = 100.0;
  for (int s = 0; s < 100; ++s) {
    std::vector<MinorOpening> openings = numbered(sizes.size());
    draw_openings(sizes, 16, s / 100.0, openings);
    bool found = false;
    for (const MinorOpening& o : openings) found = found || (o.opening == 500 && o.weight == 1.0F);
    EXPECT_TRUE(found);
  }
}

}  // namespace
}  // namespace clerestory::lighting
