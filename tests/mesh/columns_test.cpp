// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/columns.h"

#include <gtest/gtest.h>

#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace clerestory::mesh {
namespace {

constexpr Raster kThreeByTwo{.nx = 3, .ny = 2};

TEST(Raster, NoColumnIsBesideTheBorder) {
  EXPECT_EQ(kThreeByTwo.beside(4, 1, 0), std::optional(5U));
  EXPECT_EQ(kThreeByTwo.beside(4, -1, -1), std::optional(0U));
  EXPECT_EQ(kThreeByTwo.beside(3, -1, 0), std::nullopt);
  EXPECT_EQ(kThreeByTwo.beside(2, 1, 0), std::nullopt);
  EXPECT_EQ(kThreeByTwo.beside(2, 0, -1), std::nullopt);
  EXPECT_EQ(kThreeByTwo.beside(4, 0, 1), std::nullopt);
}

TEST(Raster, TheFourBesideAreThoseBesideEachSide) {
  for (std::uint32_t c = 0; c < kThreeByTwo.count(); ++c) {
    const auto four = kThreeByTwo.four_beside(c);
    EXPECT_EQ(four[0], kThreeByTwo.beside(c, -1, 0));
    EXPECT_EQ(four[1], kThreeByTwo.beside(c, 1, 0));
    EXPECT_EQ(four[2], kThreeByTwo.beside(c, 0, -1));
    EXPECT_EQ(four[3], kThreeByTwo.beside(c, 0, 1));
  }
}

TEST(Raster, PairsAreVisitedOnce) {
  using Pair = std::tuple<std::uint32_t, std::uint32_t, int>;
  std::vector<Pair> pairs;
  kThreeByTwo.for_each_pair([&](std::uint32_t c, std::uint32_t d, int axis) { pairs.emplace_back(c, d, axis); });
  EXPECT_EQ(pairs, (std::vector<Pair>{{0, 1, 0}, {0, 3, 1}, {1, 2, 0}, {1, 4, 1}, {2, 5, 1}, {3, 4, 0}, {4, 5, 0}}));
}

TEST(Columns, SpansThatOnlyTouchDoNotOverlap) {
  const Columns columns{.raster = {.nx = 2, .ny = 1},
                        .starts = {0, 3, 6},
                        .spans = {{0, 0, 1}, {0, 2, 5}, {0, 6, 9}, {1, 1, 2}, {1, 2, 3}, {1, 4, 7}}};
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Pair> pairs;
  for_each_overlap(columns, 0, 1, [&](std::uint32_t s, std::uint32_t t) { pairs.emplace_back(s, t); });
  EXPECT_EQ(pairs, (std::vector<Pair>{{1, 4}, {1, 5}, {2, 5}}));
}

}  // namespace
}  // namespace clerestory::mesh
