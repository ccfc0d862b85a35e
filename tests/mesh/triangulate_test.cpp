// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangulate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace clerestory::mesh {
namespace {

using Segments = std::vector<std::array<std::uint32_t, 2>>;

Segments loop(std::uint32_t first, std::uint32_t count) {
  Segments segments;
  for (std::uint32_t i = 0; i < count; ++i) segments.push_back({first + i, first + (i + 1) % count});
  return segments;
}

double total_area(const PlanarMesh& mesh) {
  double sum = 0.0;
  for (const PlanarTriangle& t : mesh.triangles) {
    const double doubled =
        doubled_area(mesh.points[t.vertices[0]], mesh.points[t.vertices[1]], mesh.points[t.vertices[2]]);
    EXPECT_GT(doubled, 0.0);
    sum += 0.5 * doubled;
  }
  return sum;
}

PlanarMesh inside(const std::vector<Point2>& points, const Segments& boundary, const Segments& lines = {}) {
  PlanarGraph graph{points, boundary};
  graph.segments.insert(graph.segments.end(), lines.begin(), lines.end());
  return triangulate_inside(graph, boundary, 1e-6);
}

TEST(Triangulate, FillsANonConvexPolygon) {
  const PlanarMesh mesh = inside({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}, loop(0, 6));
  EXPECT_DOUBLE_EQ(total_area(mesh), 12.0);
  EXPECT_EQ(mesh.component_count, 1U);
  EXPECT_EQ(mesh.triangles.size(), 4U);
}

TEST(Triangulate, LeavesHolesOut) {
  Segments boundary = loop(0, 4);
  for (const auto& s : loop(4, 4)) boundary.push_back(s);
  const PlanarMesh mesh = inside({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}}, boundary);
  EXPECT_DOUBLE_EQ(total_area(mesh), 12.0);
  EXPECT_EQ(mesh.component_count, 1U);
}

TEST(Triangulate, CountsOverlapOnceAndBothLobesOfABowTie) {
  Segments boundary = loop(0, 4);
  for (const auto& s : loop(4, 4)) boundary.push_back(s);
  EXPECT_NEAR(total_area(inside({{0, 0}, {2, 0}, {2, 1}, {0, 1}, {1, 0}, {3, 0}, {3, 1}, {1, 1}}, boundary)), 3.0,
              1e-12);
  EXPECT_NEAR(total_area(inside({{0, 0}, {2, 2}, {2, 0}, {0, 2}}, loop(0, 4))), 2.0, 1e-12);
}

TEST(Triangulate, PartsComponentsByLinesThatReachAcross) {
  const std::vector<Point2> points{{0, 0}, {2, 0}, {4, 0}, {4, 2}, {2, 2}, {0, 2}, {1, 0.5}, {1, 1.5}};
  EXPECT_EQ(inside(points, loop(0, 6), {{1, 4}}).component_count, 2U);
  const PlanarMesh free_standing = inside(points, loop(0, 6), {{6, 7}});
  EXPECT_EQ(free_standing.component_count, 1U);
  int constrained_inside = 0;
  for (const PlanarTriangle& t : free_standing.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<std::uint32_t, 2> edge{t.vertices[k], t.vertices[(k + 1) % 3]};
      if ((t.constrained >> k & 1U) != 0 && edge[0] >= 6 && edge[1] >= 6) ++constrained_inside;
    }
  }
  EXPECT_EQ(constrained_inside, 2);  // the line, from either side
}

TEST(Triangulate, LeavesNoSliversWhereRoundedPointsLieAlongALine) {
  // A strip at an odd angle with many points along its sides, none of them exactly on a line.
  std::vector<Point2> points;
  const double c = std::cos(0.37);
  const double s = std::sin(0.37);
  const auto add = [&](double x, double y) { points.push_back({c * x - s * y, s * x + c * y}); };
  for (int i = 0; i <= 50; ++i) add(0.2 * i, 0.0);
  for (int i = 50; i >= 0; --i) add(0.2 * i, 1.0);
  const PlanarMesh mesh = inside(points, loop(0, static_cast<std::uint32_t>(points.size())));
  EXPECT_NEAR(total_area(mesh), 10.0, 1e-12);
  EXPECT_EQ(mesh.component_count, 1U);
  EXPECT_EQ(mesh.triangles.size(), 100U);
}

TEST(Triangulate, GivesSegmentsThatCrossACommonPoint) {
  const PlanarMesh mesh = inside({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, loop(0, 4), {{0, 2}, {1, 3}});
  ASSERT_EQ(mesh.points.size(), 5U);
  EXPECT_DOUBLE_EQ(mesh.points[4].x, 1.0);
  EXPECT_EQ(mesh.component_count, 4U);
}

TEST(Triangulate, GivesNothingForPointsOnALine) {
  EXPECT_TRUE(triangulate({{{0, 0}, {1, 1}, {2, 2}}, {{0, 1}, {1, 2}}}).triangles.empty());
}

}  // namespace
}  // namespace clerestory::mesh
