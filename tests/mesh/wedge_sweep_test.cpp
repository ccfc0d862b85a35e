// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/wedge_sweep.h"

#include <gtest/gtest.h>

namespace clerestory::mesh {
namespace {

using Role = SweptSegment::Role;

TEST(WedgeSweep, TakesTheNearestReceiverWhereNothingBlocks) {
  std::vector<SweptSegment> segments{{0.0, 5.0, 1.0, 5.0, 0, Role::kReceives},
                                     {0.25, 2.0, 0.5, 2.0, 1, Role::kReceives},
                                     {0.75, 9.0, 1.0, 9.0, 2, Role::kBlocks}};
  const auto lit = sweep(segments, {});
  ASSERT_EQ(lit.size(), 3U);
  EXPECT_EQ(segments[lit[0].segment].item, 0U);
  EXPECT_EQ(segments[lit[1].segment].item, 1U);
  EXPECT_EQ(segments[lit[2].segment].item, 0U);
  EXPECT_DOUBLE_EQ(lit[1].u0, 0.25);
  EXPECT_DOUBLE_EQ(lit[2].u1, 0.75);
}

TEST(WedgeSweep, EndsStretchesAtCuts) {
  std::vector<SweptSegment> segments{{0.0, 1.0, 1.0, 2.0, 0, Role::kReceives}};
  const std::vector<double> cuts{0.5, 1.5};
  const auto lit = sweep(segments, cuts);
  ASSERT_EQ(lit.size(), 2U);
  EXPECT_DOUBLE_EQ(lit[0].u1, 0.5);
}

TEST(WedgeSweep, GivesNothingForNothing) {
  std::vector<SweptSegment> segments;
  EXPECT_TRUE(sweep(segments, {}).empty());
}

}  // namespace
}  // namespace clerestory::mesh
