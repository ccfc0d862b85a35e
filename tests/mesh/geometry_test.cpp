// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry.h"

#include <gtest/gtest.h>

namespace clerestory::mesh {
namespace {

constexpr Box kUnit{{0, 0, 0}, {1, 1, 1}};

TEST(Geometry, InteriorsOverlapWhereABoxReachesIntoTheOther) {
  EXPECT_TRUE(interiors_overlap(kUnit, kUnit));
  EXPECT_TRUE(interiors_overlap(kUnit, {{0.9, 0.9, 0.9}, {2, 2, 2}}));
  EXPECT_TRUE(interiors_overlap({{0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}}, kUnit));
}

TEST(Geometry, InteriorsOfTouchingBoxesDoNotOverlap) {
  EXPECT_FALSE(interiors_overlap(kUnit, {{1, 0, 0}, {2, 1, 1}}));
  EXPECT_FALSE(interiors_overlap(kUnit, {{0, -1, 0}, {1, 0, 1}}));
  EXPECT_FALSE(interiors_overlap(kUnit, {{1, 1, 1}, {2, 2, 2}}));
  EXPECT_FALSE(interiors_overlap(kUnit, {{0, 0, 3}, {1, 1, 4}}));
  EXPECT_FALSE(interiors_overlap(kUnit, Box{}));
}

TEST(Geometry, AFlatBoxOverlapsWhatItDividesAndNotWhatHasAFaceInItsPlane) {
  EXPECT_TRUE(interiors_overlap(kUnit, {{0, 0, 0.5}, {1, 1, 0.5}}));
  EXPECT_FALSE(interiors_overlap(kUnit, {{0, 0, 1}, {1, 1, 1}}));
}

}  // namespace
}  // namespace clerestory::mesh
