// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/disjoint_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace clerestory::mesh {
namespace {

TEST(DisjointSets, EveryNumberIsAloneAtFirst) {
  DisjointSets<std::uint32_t> sets(4);
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(sets.root(i), i);
}

TEST(DisjointSets, JoinsAreTransitiveAndTouchNothingElse) {
  DisjointSets<std::int32_t> sets(6);
  sets.join(1, 4);
  sets.join(5, 4);
  EXPECT_EQ(sets.root(1), sets.root(5));
  EXPECT_NE(sets.root(0), sets.root(1));
  EXPECT_NE(sets.root(2), sets.root(3));
}

TEST(DisjointSets, TheRootIsTheSmallestMemberInWhateverOrderTheSetWasJoined) {
  constexpr std::uint32_t kCount = 50;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 3; i < kCount; ++i) pairs.emplace_back(i, i - 3);
  std::mt19937 random(3);
  for (int order = 0; order < 10; ++order) {
    std::shuffle(pairs.begin(), pairs.end(), random);
    DisjointSets<std::uint32_t> sets(kCount);
    for (const auto& [a, b] : pairs) sets.join(a, b);
    for (std::uint32_t i = 0; i < kCount; ++i) EXPECT_EQ(sets.root(i), i % 3);
  }
}

}  // namespace
}  // namespace clerestory::mesh
