// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/seen_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <span>
#include <vector>

#include "tests/support/blocked_lamp.h"

namespace clerestory::mesh {
namespace {

constexpr std::array<Point, 3> kTriangle{Point{0, 0, 2}, Point{0, 1, 2}, Point{1, 0, 2}};

double area_of(const std::vector<ConvexPiece>& pieces) {
  double area = 0.0;
  for (const ConvexPiece& piece : pieces) {
    for (std::size_t i = 1; i + 1 < piece.count; ++i) {
      area += 0.5 * dot(cross(piece.corners[i] - piece.corners[0], piece.corners[i + 1] - piece.corners[0]),
                        Vector{0, 0, -1});  // the triangle's winding
    }
  }
  return area;
}

double seen_area(const Point& from, const std::vector<std::vector<Point>>& blockers) {
  const std::vector<std::span<const Point>> spans(blockers.begin(), blockers.end());
  const auto pieces = seen_parts(from, kTriangle, spans);
  return pieces ? area_of(*pieces) : -1.0;
}

std::vector<Point> level_rectangle(double x0, double y0, double x1, double y1, double z) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

TEST(SeenParts, OfATriangleWithoutBlockersIsTheTriangle) { EXPECT_DOUBLE_EQ(seen_area({0.2, 0.2, 0}, {}), 0.5); }

TEST(SeenParts, ABlockerHidesItsShadowWhicheverWayItIsWound) {
  // Seen from the origin a plate at half the height covers twice its sides.
  std::vector<Point> plate = level_rectangle(-1, -1, 0.25, 1, 1);
  EXPECT_NEAR(seen_area({0, 0, 0}, {plate}), 0.125, 1e-12);
  std::reverse(plate.begin(), plate.end());
  EXPECT_NEAR(seen_area({0, 0, 0}, {plate}), 0.125, 1e-12);
}

TEST(SeenParts, BlockersThatTouchHideAsOne) {
  EXPECT_NEAR(seen_area({0, 0, 0}, {level_rectangle(-1, -1, 0.1, 1, 1), level_rectangle(0.1, -1, 0.25, 1, 1)}), 0.125,
              1e-12);
  EXPECT_EQ(seen_area({0, 0, 0}, {level_rectangle(-1, -1, 0.1, 1, 1), level_rectangle(0.1, -1, 2, 1, 1)}), 0.0);
}

TEST(SeenParts, WhatOnlyTouchesHidesNothing) {
  EXPECT_DOUBLE_EQ(seen_area({0, 0, 0}, {level_rectangle(-1, -1, 0, 1, 1)}), 0.5);
  EXPECT_DOUBLE_EQ(seen_area({0, 0, 0}, {level_rectangle(-1, -1, 1, 1, 2)}), 0.5);
  EXPECT_DOUBLE_EQ(seen_area({0, 0, 0}, {level_rectangle(-1, -1, 1, 1, 3)}), 0.5);
  EXPECT_DOUBLE_EQ(seen_area({0, 0, 0}, {level_rectangle(-1, -1, 1, 1, 0)}), 0.5);
  EXPECT_DOUBLE_EQ(seen_area({0, 0, 0}, {level_rectangle(-1, -1, 1, 1, -1)}), 0.5);
}

TEST(SeenParts, AScreenThatReachesBelowThePointHidesWhatIsBehindIt) {
  // An upright screen at x = 0.1, from below the point to the height at which it just hides x > 0.25.
  const std::vector<Point> screen{{0.1, -5, -1}, {0.1, 5, -1}, {0.1, 5, 0.8}, {0.1, -5, 0.8}};
  EXPECT_NEAR(seen_area({0, 0, 0}, {screen}), 0.5 - 0.5 * 0.75 * 0.75, 1e-12);
}

TEST(SeenParts, OfManyBlockersGiveTheLightOfTheOracle) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.4, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    support::BlockedLamp scene;
    scene.lamp.assign(kTriangle.begin(), kTriangle.end());
    for (int i = 0; i < 6; ++i) {
      const Point p{place(random), place(random), 0.8 + place(random)};
      scene.blockers.push_back({p, p + Vector{0.3, 0.1, 0.2 * place(random)}, p + Vector{-0.1, 0.3, place(random)}});
    }
    const Point from{place(random), place(random), 0};
    const std::vector<std::span<const Point>> spans(scene.blockers.begin(), scene.blockers.end());
    const auto pieces = seen_parts(from, kTriangle, spans);
    ASSERT_TRUE(pieces);
    double factor = 0.0;
    for (const ConvexPiece& piece : *pieces) {
      const std::vector<Point> corners(piece.corners.begin(),
                                       piece.corners.begin() + static_cast<std::ptrdiff_t>(piece.count));
      factor += support::exact_illuminance({.lamp = corners, .exitance_lm_m2 = 1.0, .blockers = {}}, from, {0, 0, 1});
    }
    EXPECT_NEAR(factor, support::exact_illuminance(scene, from, {0, 0, 1}), 1e-9);
  }
}

TEST(SeenParts, ACrowdOfBlockersIsRefused) {
  std::vector<std::vector<Point>> blockers;
  for (int i = 0; i < 400; ++i) {
    const double x = 0.01 + 0.02 * (i % 20);
    const double y = 0.01 + 0.02 * (i / 20);
    blockers.push_back(level_rectangle(x, y, x + 0.01, y + 0.01, 1));
  }
  EXPECT_EQ(seen_area({0, 0, 0}, blockers), -1.0);
}

}  // namespace
}  // namespace clerestory::mesh
