// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/planar.h"

#include <gtest/gtest.h>

namespace clerestory::mesh {
namespace {

std::vector<PlanarOutline::Segment> square(double low, double high, bool hole = false) {
  std::vector<Point2> p{{low, low}, {high, low}, {high, high}, {low, high}};
  if (hole) std::swap(p[1], p[3]);
  return {{p[0], p[1]}, {p[1], p[2]}, {p[2], p[3]}, {p[3], p[0]}};
}

PlanarOutline square_with_hole() {
  std::vector<PlanarOutline::Segment> segments = square(0, 4);
  for (const auto& s : square(1, 3, true)) segments.push_back(s);
  return PlanarOutline(segments);
}

TEST(PlanarOutline, WindsRoundItsInside) {
  const PlanarOutline outline = square_with_hole();
  EXPECT_EQ(outline.winding({0.5, 0.5}), 1);
  EXPECT_EQ(outline.winding({2, 2}), 0);
  EXPECT_EQ(outline.winding({5, 2}), 0);
  EXPECT_EQ(outline.winding({-1, 1}), 0);  // its ray runs through corners
  EXPECT_TRUE(outline.near_boundary({2, 1.001}, 0.01));
  EXPECT_FALSE(outline.near_boundary({2, 1.02}, 0.01));
}

TEST(PlanarOutline, CutsASegmentAtHolesAndBorders) {
  const std::vector<Stretch> stretches = square_with_hole().inner_stretches({-4, 2}, {6, 2}, 1e-5);
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_NEAR(stretches[0].begin, 0.4, 1e-12);
  EXPECT_NEAR(stretches[0].end, 0.5, 1e-12);
  EXPECT_NEAR(stretches[1].begin, 0.7, 1e-12);
  EXPECT_NEAR(stretches[1].end, 0.8, 1e-12);
}

TEST(PlanarOutline, TakesNoSegmentAlongItsBoundary) {
  const PlanarOutline outline = square_with_hole();
  EXPECT_TRUE(outline.inner_stretches({-1, 0}, {5, 0}, 1e-5).empty());
  EXPECT_TRUE(outline.inner_stretches({0, 1e-6}, {4, 1e-6}, 1e-5).empty());
  // Along the hole's side, then on through the material.
  const std::vector<Stretch> stretches = outline.inner_stretches({0, 1}, {4, 1}, 1e-5);
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_NEAR(stretches[0].end, 0.25, 1e-12);
  EXPECT_NEAR(stretches[1].begin, 0.75, 1e-12);
}

TEST(PlaneCoordinates, LiftWhatTheyProject) {
  const PlaneCoordinates plane{{1, 2, 3}, frame_around(normalized({1, -2, 0.5}))};
  const Point p = plane.lift({0.7, -1.3});
  EXPECT_NEAR(plane.distance(p), 0.0, 1e-15);
  EXPECT_NEAR(plane.project(p).x, 0.7, 1e-15);
  EXPECT_NEAR(plane.project(p).y, -1.3, 1e-15);
}

}  // namespace
}  // namespace clerestory::mesh
