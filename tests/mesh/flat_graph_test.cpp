// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/flat_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clerestory::mesh {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

/// The plane x = 2, seen from +x: its coordinates are y and z.
constexpr PlaneCoordinates kPlane{{2, 0, 0}, {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}};

TEST(FlatGraph, NumbersVerticesInTheOrderInWhichTheyComeEachOnce) {
  const std::vector<Point> points{{2, 0, 0}, {9, 9, 9}, {2, 3, 0}, {2, 3, 4}};
  FlatGraph flat(points, kPlane);
  EXPECT_THAT(flat.add(3, 0), ElementsAre(0U, 1U));
  EXPECT_THAT(flat.add(0, 2), ElementsAre(1U, 2U));
  EXPECT_THAT(flat.add(2, 3), ElementsAre(2U, 0U));
  EXPECT_THAT(flat.vertices(), ElementsAre(3U, 0U, 2U));
  EXPECT_THAT(flat.graph().segments, ElementsAre(ElementsAre(0U, 1U), ElementsAre(1U, 2U), ElementsAre(2U, 0U)));
}

TEST(FlatGraph, ItsPointsAreTheVerticesInThePlane) {
  const std::vector<Point> points{{2, 5, 6}, {2.5, 3, 4}};
  FlatGraph flat(points, kPlane);
  flat.add(1, 0);
  ASSERT_THAT(flat.graph().points, SizeIs(2));
  EXPECT_EQ(flat.graph().points[0].x, 3.0);
  EXPECT_EQ(flat.graph().points[0].y, 4.0);
  EXPECT_EQ(flat.graph().points[1].x, 5.0);
  EXPECT_EQ(flat.graph().points[1].y, 6.0);
}

}  // namespace
}  // namespace clerestory::mesh
