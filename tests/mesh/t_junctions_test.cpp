// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/t_junctions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "mesh/weld.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

Soup welded(const Model& model) {
  Soup soup = to_soup(model);
  DefectList ignored;
  weld(soup, 2e-5, ignored);
  return soup;
}

/// A brick wall in the plane z = x·tan: rows of quads, every other row displaced by half a brick, ends filled.
Model brick_wall(int rows, int columns) {
  Model model;
  for (int r = 0; r < rows; ++r) {
    std::vector<double> joints{0.0};
    for (int c = r % 2 == 0 ? 2 : 1; c < 2 * columns; c += 2) joints.push_back(0.5 * c);
    joints.push_back(columns);
    for (std::size_t i = 1; i < joints.size(); ++i) {
      support::add_quad(model, {joints[i - 1], 0, 0.1 * r}, {joints[i], 0, 0.1 * r}, {joints[i], 0, 0.1 * (r + 1)},
                        {joints[i - 1], 0, 0.1 * (r + 1)});
    }
  }
  return support::rotated(model, {0.3, -0.2, 0.9}, 0.7);
}

TEST(TJunctions, LeaveEveryInnerEdgeToExactlyTwoPolygons) {
  Soup soup = welded(brick_wall(20, 10));
  DefectList defects;
  EXPECT_TRUE(split_t_junctions(soup, 2e-5, defects));
  std::map<Edge, int> uses;
  double length_once = 0.0;
  for (const SoupPolygon& polygon : soup.polygons) {
    for_each_edge(polygon, [&](std::uint32_t a, std::uint32_t b) { ++uses[edge_between(a, b)]; });
  }
  for (const auto& [edge, count] : uses) {
    ASSERT_LE(count, 2);
    if (count == 1) length_once += norm(soup.points[edge[0]] - soup.points[edge[1]]);
  }
  EXPECT_NEAR(length_once, 2 * (10.0 + 2.0), 1e-9);  // the wall's outline
}

TEST(TJunctions, AreGoneAfterwards) {
  Soup soup = welded(brick_wall(7, 5));
  DefectList defects;
  split_t_junctions(soup, 2e-5, defects);
  EXPECT_FALSE(split_t_junctions(soup, 2e-5, defects));
}

TEST(TJunctions, AreMatchedWithinTheToleranceAndNotBeyond) {
  for (const auto& [offset, corners] : {std::pair{1e-5, 5U}, std::pair{1e-4, 4U}}) {
    Model model;
    support::add_quad(model, {0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {"wall", "a"});
    support::add_triangle(model, {1, 0, offset}, {2, -1, 0.5}, {0, -1, 0.5}, {"wall", "b"});
    Soup soup = welded(model);
    DefectList defects;
    split_t_junctions(soup, 2e-5, defects);
    EXPECT_EQ(soup.polygons[0].loops[0].size(), corners);
  }
}

TEST(SegmentSearch, GivesVerticesInOrderAlongTheEdge) {
  const std::vector<Point> points{{10, 0, 0}, {0, 0, 0}, {7, 0, 0}, {3, 0, 0}, {5, 1, 0}, {11, 0, 0}, {5, 0, 0}};
  EXPECT_THAT(SegmentSearch(points, 1e-3).on({0, 1}), testing::ElementsAre(2, 6, 3));
  EXPECT_THAT(SegmentSearch(points, 1e-3, 3).on({0, 1}), testing::ElementsAre(6, 3));
}

}  // namespace
}  // namespace clerestory::mesh
