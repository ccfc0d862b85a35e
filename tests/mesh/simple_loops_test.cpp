// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/simple_loops.h"

#include <gtest/gtest.h>

#include <array>

namespace clerestory::mesh {
namespace {

using Loop = std::vector<std::uint32_t>;

/// A square of 4 m (0 to 3), one of 2 m in its middle (4 to 7), one of 4 m beside it at x = 6 (8 to 11).
Soup squares(std::vector<Loop> loops) {
  Soup soup;
  for (const auto& [low, size, x] : {std::array{0.0, 4.0, 0.0}, std::array{1.0, 2.0, 1.0}, std::array{0.0, 4.0, 6.0}}) {
    soup.points.push_back({x, low, 0});
    soup.points.push_back({x + size, low, 0});
    soup.points.push_back({x + size, low + size, 0});
    soup.points.push_back({x, low + size, 0});
  }
  soup.polygons.push_back({std::move(loops), MaterialId(0U), PartId(0U), 0, 0});
  return soup;
}

double total_area(const Soup& soup) {
  double sum = 0.0;
  for (const SoupPolygon& polygon : soup.polygons) sum += area(soup.points, polygon);
  return sum;
}

TEST(SimpleLoops, LeavesPolygonsThatAreSimple) {
  Soup soup = squares({{0, 1, 2, 3}, {7, 6, 5, 4}});
  DefectList defects;
  EXPECT_FALSE(separate_loops(soup, defects));
  EXPECT_EQ(soup.polygons[0].loops.size(), 2U);
}

TEST(SimpleLoops, MakesABridgedHoleALoop) {
  Soup soup = squares({{0, 1, 2, 3, 0, 4, 7, 6, 5, 4}});
  DefectList defects;
  EXPECT_TRUE(separate_loops(soup, defects));
  ASSERT_EQ(soup.polygons.size(), 1U);
  EXPECT_EQ(soup.polygons[0].loops.size(), 2U);
  EXPECT_DOUBLE_EQ(total_area(soup), 12.0);
  EXPECT_GT(newell(soup.points, soup.polygons[0].loops[0]).z, 0.0);
  EXPECT_LT(newell(soup.points, soup.polygons[0].loops[1]).z, 0.0);
}

TEST(SimpleLoops, TakesABridgedHoleThatGoesTheWrongWayRound) {
  Soup soup = squares({{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}});
  DefectList defects;
  separate_loops(soup, defects);
  ASSERT_EQ(soup.polygons.size(), 1U);
  EXPECT_DOUBLE_EQ(total_area(soup), 12.0);
}

TEST(SimpleLoops, MakesBridgedIslandsPolygons) {
  Soup soup = squares({{0, 1, 8, 9, 10, 11, 8, 1, 2, 3}});
  DefectList defects;
  separate_loops(soup, defects);
  EXPECT_EQ(soup.polygons.size(), 2U);
  EXPECT_DOUBLE_EQ(total_area(soup), 32.0);
}

TEST(SimpleLoops, DropsRepeatedCornersAndSpikes) {
  Soup soup = squares({{0, 1, 1, 9, 1, 2, 2, 3, 0}});
  DefectList defects;
  separate_loops(soup, defects);
  ASSERT_EQ(soup.polygons.size(), 1U);
  EXPECT_DOUBLE_EQ(total_area(soup), 16.0);
  EXPECT_EQ(soup.polygons[0].loops, (std::vector<Loop>{{0, 1, 2, 3}}));
  EXPECT_EQ(std::move(defects).take({})[0].kind, "repeated corners");
}

TEST(SimpleLoops, LeavesNothingOfALoopWithoutArea) {
  Soup soup = squares({{0, 1, 2, 1}});
  DefectList defects;
  separate_loops(soup, defects);
  ASSERT_EQ(soup.polygons.size(), 1U);
  EXPECT_TRUE(soup.polygons[0].loops.empty());
}

}  // namespace
}  // namespace clerestory::mesh
