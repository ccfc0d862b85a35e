// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/triangle_grids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace clerestory::mesh {
namespace {

using Triangles = std::vector<std::array<Point, 3>>;

constexpr double kSlackM = 1e-4;

/// Two triangles for each square of a lattice over [0, x] × [0, y], askew in space.
Triangles lattice(const Frame& axes, double x, double y, std::size_t columns, std::size_t rows) {
  const auto at = [&](std::size_t i, std::size_t j) {
    return Point{100.0, -3.0, 7.0} + (x * static_cast<double>(i) / static_cast<double>(columns) * axes.u +
                                      y * static_cast<double>(j) / static_cast<double>(rows) * axes.v);
  };
  Triangles found;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      found.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      found.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return found;
}

Frame askew() { return frame_around(normalized({1.0, 2.0, -3.0})); }

bool is_near(const TriangleGrids& grids, std::size_t grid, const Point& p, std::uint32_t triangle) {
  return std::ranges::binary_search(grids.near(grid, p), triangle);
}

/// Points of a triangle, its corners, and points just beside them.
std::vector<Point> points_of(const std::array<Point, 3>& t, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Point> found(t.begin(), t.end());
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector outwards = normalized(midpoint(t[k], t[(k + 1) % 3]) - t[(k + 2) % 3]);
    found.push_back(midpoint(t[k], t[(k + 1) % 3]) + 0.7 * kSlackM * outwards);
  }
  for (int i = 0; i < 10; ++i) {
    const double a = uniform(random);
    found.push_back(t[0] + (a * (t[1] - t[0]) + (1.0 - a) * uniform(random) * (t[2] - t[0])));
  }
  return found;
}

TEST(TriangleGrids, PointsFindTheirTriangle) {
  std::mt19937 random(1);
  TriangleGrids grids;
  const std::array<Triangles, 4> regions{lattice(askew(), 3.0, 2.0, 12, 7), lattice(askew(), 50.0, 0.01, 40, 1),
                                         lattice(askew(), 1e-3, 1e-3, 3, 3), lattice(askew(), 4.0, 4.0, 1, 1)};
  std::uint32_t first = 0;
  for (std::size_t grid = 0; grid < regions.size(); ++grid) {
    grids.add(askew(), regions[grid], first, kSlackM);
    for (std::uint32_t i = 0; i < regions[grid].size(); ++i) {
      for (const Point& p : points_of(regions[grid][i], random)) EXPECT_TRUE(is_near(grids, grid, p, first + i));
    }
    first += static_cast<std::uint32_t>(regions[grid].size());
  }
}

TEST(TriangleGrids, FewTrianglesAreNearAPoint) {
  TriangleGrids grids;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const Triangles triangles = lattice(askew(), 30.0, 20.0, 60, 40);
  grids.add(askew(), triangles, 0, kSlackM);
  std::size_t near = 0;
  std::size_t points = 0;
  for (const auto& t : triangles) {
    for (int i = 0; i < 10; ++i) {
      const double a = uniform(random);
      near += grids.near(0, t[0] + (a * (t[1] - t[0]) + (1.0 - a) * uniform(random) * (t[2] - t[0]))).size();
      ++points;
    }
  }
  EXPECT_LT(near, 4 * points);
}

TEST(TriangleGrids, ThinTrianglesAskewTakeNoMoreCellsThanTheyAreMany) {
  // Each reaches from one side of the square to the other: a grid as fine as they are wide would have 100 million entries.
  TriangleGrids grids;
  Triangles thin;
  const Frame axes = askew();
  for (int i = 0; i < 10'000; ++i) {
    const Point low = Point{} + 1e-4 * i * axes.u;
    const Point high = Point{} + (1.0 - 1e-4 * i) * axes.u + axes.v;
    thin.push_back({low, low + 1e-4 * axes.u, high});
  }
  grids.add(axes, thin, 0, 1e-9);
  std::size_t entries = 0;
  grids.any_within(0, Point{}, 10.0, [&](std::span<const std::uint32_t> near) {
    entries += near.size();
    return false;
  });
  EXPECT_LT(entries, 20 * thin.size());
}

TEST(TriangleGrids, SmallTrianglesInACornerTakeNoMoreCellsThanTheyAreMany) {
  TriangleGrids grids;
  Triangles triangles = lattice(askew(), 0.01, 0.01, 30, 30);
  const Triangles large = lattice(askew(), 100.0, 100.0, 1, 1);
  triangles.insert(triangles.end(), large.begin(), large.end());
  grids.add(askew(), triangles, 0, kSlackM);
  std::size_t cells = 0;
  grids.any_within(0, large[0][0], 1000.0, [&](std::span<const std::uint32_t>) {
    ++cells;
    return false;
  });
  EXPECT_LE(cells, 4 * triangles.size());
}

TEST(TriangleGrids, NothingIsNearAPointInAHole) {
  TriangleGrids grids;
  Triangles triangles = lattice(askew(), 3.0, 3.0, 15, 15);
  std::erase_if(triangles, [](const std::array<Point, 3>& t) {
    const Vector d = t[0] - (Point{100.0, -3.0, 7.0} + (1.5 * askew().u + 1.5 * askew().v));
    return norm(d) < 1.0;
  });
  grids.add(askew(), triangles, 0, kSlackM);
  const Point middle = Point{100.0, -3.0, 7.0} + (1.5 * askew().u + 1.5 * askew().v);
  EXPECT_TRUE(grids.near(0, middle).empty());
  const auto is_any = [](std::span<const std::uint32_t> near) { return !near.empty(); };
  EXPECT_FALSE(grids.any_within(0, middle, 0.1, is_any));
  EXPECT_TRUE(grids.any_within(0, middle, 1.5, is_any));
}

}  // namespace
}  // namespace clerestory::mesh
