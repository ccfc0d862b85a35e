// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "mesh/solids.h"

namespace clerestory::mesh {
namespace {

Solid box(const Point& low, const Point& high) {
  const std::vector<Point> loop{low, {high.x, low.y, low.z}, {high.x, high.y, low.z}, {low.x, high.y, low.z}};
  return prism({&loop, 1}, {0.0, 0.0, high.z - low.z});
}

TEST(SolidBooleans, DifferenceAndIntersectionShareTheBody) {
  const Solid wall = box({0, 0, 0}, {4, 0.3, 3});
  const Solid hole = box({1, -1, 1}, {2, 1, 2});
  const auto left = difference(wall, hole);
  const auto taken = intersection(wall, hole);
  ASSERT_TRUE(left && taken);
  EXPECT_NEAR(volume(*left), 3.6 - 0.3, 1e-9);
  EXPECT_NEAR(volume(*taken), 0.3, 1e-9);
  EXPECT_TRUE(is_closed(*left));
  EXPECT_NEAR(surface_area(*left), surface_area(wall) - 2.0 + 4 * 0.3, 1e-9);
}

/// The film that exact arithmetic would leave has two sides of 1 m2.
TEST(SolidBooleans, NoFilmIsLeftWherePlanesDifferByRounding) {
  const Solid wall = box({0, 0, 0}, {4, 0.3, 3});
  const Solid hole = box({1, 1e-16, 1}, {2, 0.1 + 0.2, 2});
  const auto left = difference(wall, hole);
  ASSERT_TRUE(left);
  EXPECT_NEAR(surface_area(*left), surface_area(wall) - 2.0 + 4 * 0.3, 1e-6);
}

TEST(SolidBooleans, UnionOfBoxesThatShareAFaceHasNoFaceInside) {
  const auto both = united(box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1}));
  ASSERT_TRUE(both);
  EXPECT_NEAR(volume(*both), 2.0, 1e-9);
  EXPECT_NEAR(surface_area(*both), 10.0, 1e-9);
}

TEST(SolidBooleans, WhatIsTakenAwayWholeLeavesNothing) {
  const auto left = difference(box({0, 0, 0}, {1, 1, 1}), box({-1, -1, -1}, {2, 2, 2}));
  ASSERT_TRUE(left);
  EXPECT_TRUE(left->empty());
}

TEST(SolidBooleans, OpenShellLosesWhatLiesInTheTool) {
  Solid sheet;
  add_face(sheet, std::vector<std::vector<Point>>{{{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}}});
  const auto left = clipped(sheet, box({1, -1, 1}, {2, 1, 2}));
  ASSERT_TRUE(left);
  EXPECT_NEAR(surface_area(*left), 11.0, 1e-9);
}

TEST(SolidBooleans, OpenShellHasNoDifference) {
  Solid shell = box({0, 0, 0}, {1, 1, 1});
  shell.triangles.pop_back();
  EXPECT_FALSE(difference(shell, box({0.2, 0.2, -1}, {0.5, 0.5, 2})));
}

}  // namespace
}  // namespace clerestory::mesh
