// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/group_outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace clerestory::mesh {
namespace {

using Triangle3 = std::array<std::uint32_t, 3>;
using Edge = std::array<std::uint32_t, 2>;

/// Points (x, y, 0) of a lattice of columns × rows, row by row.
std::vector<Point> lattice(std::uint32_t columns, std::uint32_t rows) {
  std::vector<Point> points;
  for (std::uint32_t y = 0; y < rows; ++y) {
    for (std::uint32_t x = 0; x < columns; ++x) points.push_back({0.1 * x, 0.3 * y, 0.0});
  }
  return points;
}

/// The two triangles of a lattice's cell.
void add_cell(std::uint32_t columns, std::uint32_t x, std::uint32_t y, std::vector<Triangle3>& triangles) {
  const std::uint32_t a = y * columns + x;
  triangles.push_back({a, a + 1, a + columns + 1});
  triangles.push_back({a, a + columns + 1, a + columns});
}

/// The outline of a few triangles.
std::vector<Edge> outline_of(const std::vector<Point>& points, const std::vector<Triangle3>& triangles) {
  const auto across = triangles_across(triangles);
  std::vector<Edge> edges;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (across[t][k] == kNoTriangle) edges.push_back({triangles[t][k], triangles[t][(k + 1) % 3]});
    }
  }
  return group_outline(points, edges);
}

TEST(TrianglesAcross, ShareAnEdgeTheOtherWayRound) {
  const std::vector<Triangle3> triangles{{0, 1, 2}, {2, 1, 3}, {0, 2, 4}};
  const auto across = triangles_across(triangles);
  EXPECT_EQ(across[0], (Triangle3{kNoTriangle, 1, 2}));
  EXPECT_EQ(across[1], (Triangle3{0, kNoTriangle, kNoTriangle}));
  EXPECT_EQ(across[2], (Triangle3{0, kNoTriangle, kNoTriangle}));
}

TEST(GroupOutline, EdgesInALineAreOne) {
  std::vector<Triangle3> triangles;
  for (std::uint32_t y = 0; y < 3; ++y) {
    for (std::uint32_t x = 0; x < 7; ++x) add_cell(8, x, y, triangles);
  }
  const std::vector<Edge> outline = outline_of(lattice(8, 4), triangles);
  EXPECT_EQ(outline, (std::vector<Edge>{{0, 7}, {7, 31}, {24, 0}, {31, 24}}));
}

TEST(GroupOutline, HolesGoTheOtherWayRound) {
  std::vector<Triangle3> triangles;
  for (std::uint32_t y = 0; y < 3; ++y) {
    for (std::uint32_t x = 0; x < 3; ++x) {
      if (x != 1 || y != 1) add_cell(4, x, y, triangles);
    }
  }
  const std::vector<Edge> outline = outline_of(lattice(4, 4), triangles);
  ASSERT_EQ(outline.size(), 8U);
  for (const Edge& edge : {Edge{6, 5}, Edge{5, 9}, Edge{9, 10}, Edge{10, 6}})
    EXPECT_EQ(std::count(outline.begin(), outline.end(), edge), 1);
}

TEST(GroupOutline, LinesEndWhereSeveralEdgesMeet) {
  // Two cells that touch at a corner, through which a line of the outline goes straight on.
  std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}};
  const std::vector<Triangle3> triangles{{0, 1, 3}, {1, 4, 2}};
  EXPECT_EQ(outline_of(points, triangles).size(), 6U);
}

}  // namespace
}  // namespace clerestory::mesh
