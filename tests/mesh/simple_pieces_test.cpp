// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/simple_pieces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace clerestory::mesh {
namespace {

using Loop = std::vector<std::uint32_t>;

/// A square plate with square holes in a row, triangulated.
PlanarMesh plate(std::uint32_t holes) {
  PlanarGraph graph;
  const auto add_square = [&](double x, double y, double size, bool hole) {
    const auto first = static_cast<std::uint32_t>(graph.points.size());
    for (const auto& [u, v] : {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      graph.points.push_back({x + u * size, y + v * size});
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t a = first + i;
      const std::uint32_t b = first + (i + 1) % 4;
      graph.segments.push_back(hole ? std::array{b, a} : std::array{a, b});
    }
  };
  add_square(0.0, 0.0, 3.0 * holes + 1.0, false);
  for (std::uint32_t i = 0; i < holes; ++i) add_square(1.0 + 3.0 * i, 1.0, 1.0, true);
  return triangulate_inside(graph, graph.segments, 0.0);
}

double doubled_area_of(const PlanarMesh& mesh, const Loop& loop) {
  double sum = 0.0;
  for (std::size_t i = 2; i < loop.size(); ++i)
    sum += doubled_area(mesh.points[loop[0]], mesh.points[loop[i - 1]], mesh.points[loop[i]]);
  return sum;
}

TEST(SimplePieces, OfAPlateWithHolesHaveItsAreaAndTouchThemselvesNowhere) {
  for (const std::uint32_t holes : {1U, 2U, 40U}) {
    const PlanarMesh mesh = plate(holes);
    double sum = 0.0;
    const std::vector<Loop> pieces = simple_pieces(mesh);
    for (const Loop& loop : pieces) {
      EXPECT_EQ(std::set<std::uint32_t>(loop.begin(), loop.end()).size(), loop.size());
      EXPECT_GT(doubled_area_of(mesh, loop), 0.0);
      sum += doubled_area_of(mesh, loop);
    }
    const double side = 3.0 * holes + 1.0;
    EXPECT_NEAR(sum, 2.0 * (side * side - holes), 1e-9);
    EXPECT_LT(pieces.size(), mesh.triangles.size() / 2) << holes;
  }
}

/// A wedge from the far corner to a side of 0.1 mm would be a needle.
TEST(SimplePieces, NarrowTrianglesStayWithTheirNeighbours) {
  PlanarGraph graph;
  graph.points = {{0, 0}, {2, 0}, {2, 1}, {1.0001, 1}, {1, 1}, {0, 1}};
  for (std::uint32_t i = 0; i < 6; ++i) graph.segments.push_back({i, (i + 1) % 6});
  const std::vector<Loop> pieces = simple_pieces(triangulate_inside(graph, graph.segments, 0.0));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].size(), 6U);
}

}  // namespace
}  // namespace clerestory::mesh
