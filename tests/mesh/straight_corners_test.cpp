// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/straight_corners.h"

#include <gtest/gtest.h>

#include <vector>

namespace clerestory::mesh {
namespace {

using Loop = std::vector<Point>;

TEST(StraightCorners, AreLeftOutWhereverTheLoopBegins) {
  const Loop square = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}, {0, 1.5, 0}, {0, 0.5, 0}};
  for (std::size_t first = 0; first < square.size(); ++first) {
    Loop turned(square.begin() + static_cast<std::ptrdiff_t>(first), square.end());
    turned.insert(turned.end(), square.begin(), square.begin() + static_cast<std::ptrdiff_t>(first));
    const Loop corners = without_straight_corners(turned);
    ASSERT_EQ(corners.size(), 4U) << first;
    for (const Point& p : corners) EXPECT_TRUE((p.x == 0.0 || p.x == 2.0) && (p.y == 0.0 || p.y == 2.0)) << first;
  }
}

TEST(StraightCorners, ATurnThatIsMoreThanRoundingStays) {
  const auto bent = [](double by) { return Loop{{0, 0, 0}, {1, -by, 0}, {2, 0, 0}, {1, 2, 0}}; };
  EXPECT_EQ(without_straight_corners(bent(1e-4)).size(), 4U);
  EXPECT_EQ(without_straight_corners(bent(1e-8)).size(), 3U);
}

TEST(StraightCorners, WhereALoopTurnsBackItKeepsItsCorner) {
  const Loop spike = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 4, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_EQ(without_straight_corners(spike).size(), 6U - 1U);  // on its way up to the tip it goes straight on
}

TEST(StraightCorners, OfNothingAreNone) { EXPECT_TRUE(without_straight_corners({}).empty()); }

}  // namespace
}  // namespace clerestory::mesh
