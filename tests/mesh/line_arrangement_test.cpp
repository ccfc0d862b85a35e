// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/line_arrangement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace clerestory::mesh {
namespace {

constexpr double kDistance = 1e-3;

/// The square [0, 1]².
LineArrangement square() {
  return {{{0, 0}, {1, 0}, {1, 1}, {0, 1}},
          {{0, 1, true, false}, {1, 2, true, false}, {2, 3, true, false}, {3, 0, true, false}},
          kDistance};
}

std::size_t line_count(const LineArrangement& a) {
  return static_cast<std::size_t>(std::count_if(a.segments().begin(), a.segments().end(),
                                                [](const LineArrangement::Segment& s) { return s.line; }));
}

TEST(LineArrangement, CrossingsBecomeVertices) {
  LineArrangement a = square();
  EXPECT_NEAR(a.add({0.2, 0.2}, {0.8, 0.8}), std::sqrt(0.72), 1e-12);
  EXPECT_NEAR(a.add({0.2, 0.8}, {0.8, 0.2}), std::sqrt(0.72), 1e-12);
  EXPECT_EQ(line_count(a), 4U);
  ASSERT_EQ(a.points().size(), 9U);
  EXPECT_NEAR(a.points().back().x, 0.5, 1e-12);
}

TEST(LineArrangement, LinesAlongOthersAreNotAddedAgain) {
  LineArrangement a = square();
  a.add({0.1, 0.5}, {0.9, 0.5});
  EXPECT_EQ(a.add({0.2, 0.5004}, {0.8, 0.4996}), 0.0);
  EXPECT_EQ(a.add({0.1, 0.0005}, {0.9, 0.0005}), 0.0);  // along the boundary
  EXPECT_EQ(line_count(a), 1U);
  EXPECT_EQ(a.points().size(), 6U);
}

TEST(LineArrangement, WhatReachesBeyondAnotherLineIsAdded) {
  LineArrangement a = square();
  a.add({0.1, 0.5}, {0.5, 0.5});
  EXPECT_NEAR(a.add({0.3, 0.5}, {0.9, 0.5}), 0.4, 2 * kDistance);
  EXPECT_EQ(line_count(a), 2U);
  EXPECT_EQ(a.points().size(), 7U);  // the second begins where the first ends
}

TEST(LineArrangement, EndsGoToTheBoundaryThatTheyAreNearTo) {
  LineArrangement a = square();
  a.add({0.5, 0.0004}, {0.5, 0.9996});
  ASSERT_EQ(a.points().size(), 6U);
  EXPECT_EQ(a.points()[4].y, 0.0);
  EXPECT_EQ(a.points()[5].y, 1.0);
  EXPECT_EQ(a.segments().size(), 7U);
}

TEST(LineArrangement, NoVertexIsNearALineWithoutBeingOnIt) {
  LineArrangement a = square();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  for (int i = 0; i < 60; ++i) a.add({place(random), place(random)}, {place(random), place(random)});
  const auto& points = a.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(std::hypot(points[i].x - points[j].x, points[i].y - points[j].y), 0.1 * kDistance);
    }
  }
}

}  // namespace
}  // namespace clerestory::mesh
