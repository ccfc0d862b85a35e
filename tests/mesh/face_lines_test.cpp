// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/face_lines.h"

#include <gtest/gtest.h>

#include <bit>

namespace clerestory::mesh {
namespace {

/// The square [0, 2] × [0, 1], divided by a contact at x = 1.
PlanarMesh two_squares() {
  PlanarGraph graph;
  graph.points = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}};
  const std::vector<std::array<std::uint32_t, 2>> boundary{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 0}};
  graph.segments = boundary;
  graph.segments.push_back({1, 4});
  return triangulate_inside(graph, boundary, 1e-6);
}

double area_of(const PlanarMesh& mesh) {
  double area = 0.0;
  for (const PlanarTriangle& t : mesh.triangles) {
    area += 0.5 * doubled_area(mesh.points[t.vertices[0]], mesh.points[t.vertices[1]], mesh.points[t.vertices[2]]);
  }
  return area;
}

TEST(FaceLines, DivideRegionsIntoPatches) {
  const std::vector<std::array<Point2, 2>> lines{{{{0.0, 0.4}, {2.0, 0.4}}}};
  const LinedMesh lined = with_lines(two_squares(), lines, 1e-3);
  EXPECT_EQ(lined.mesh.component_count, 4U);
  ASSERT_EQ(lined.region_of_patch.size(), 4U);
  EXPECT_NEAR(lined.length_m, 2.0, 1e-12);
  EXPECT_NEAR(area_of(lined.mesh), 2.0, 1e-12);
  for (const PlanarTriangle& t : lined.mesh.triangles) {
    const bool right =
        lined.mesh.points[t.vertices[0]].x + lined.mesh.points[t.vertices[1]].x + lined.mesh.points[t.vertices[2]].x >
        3.0;
    std::uint32_t of_side = 2;
    for (const PlanarTriangle& s : two_squares().triangles) {
      double x = 0.0;
      for (const std::uint32_t v : s.vertices) x += two_squares().points[v].x;
      if ((x > 3.0) == right) of_side = s.component;
    }
    EXPECT_EQ(lined.region_of_patch[t.component], of_side);
  }
}

TEST(FaceLines, AreConstrainedAndMayEndInside) {
  const std::vector<std::array<Point2, 2>> lines{{{{0.3, 0.4}, {0.7, 0.6}}}};
  const LinedMesh lined = with_lines(two_squares(), lines, 1e-3);
  EXPECT_EQ(lined.mesh.component_count, 2U);
  EXPECT_EQ(lined.mesh.points.size(), 8U);
  std::size_t constrained = 0;
  for (const PlanarTriangle& t : lined.mesh.triangles)
    constrained += static_cast<std::size_t>(std::popcount(t.constrained));
  EXPECT_EQ(constrained, 6U + 2U + 2U);
}

TEST(FaceLines, WithoutLinesNothingChanges) {
  const LinedMesh lined = with_lines(two_squares(), {}, 1e-3);
  EXPECT_EQ(lined.mesh.triangles.size(), two_squares().triangles.size());
  EXPECT_EQ(lined.region_of_patch, (std::vector<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace clerestory::mesh
