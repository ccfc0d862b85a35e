// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "lighting/form_factor.h"
#include "mesh/subdivision.h"
#include "tests/support/cages.h"

// What limit surfaces give to light, areas and form factors, converges to second order in the size of the triangles.
namespace clerestory {
namespace {

using mesh::Point;
using mesh::Vector;

/// A closed dome: the Catmull-Clark surface of a cube whose bottom is sharp all round.
mesh::Model dome_cage() {
  mesh::Model model = support::cube_cage();
  const auto bottom = model.loop(0);
  for (std::size_t k = 0; k < 4; ++k) model.tags.creases.push_back({{bottom[k], bottom[(k + 1) % 4]}, 10.0F});
  return model;
}

std::array<Point, 3> corners_of(const mesh::Model& model, std::size_t polygon) {
  const auto loop = model.loop(polygon);
  return {model.vertices[loop[0]], model.vertices[loop[1]], model.vertices[loop[2]]};
}

double area_of(const mesh::Model& model) {
  double area = 0.0;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    const auto c = corners_of(model, p);
    area += 0.5 * norm(cross(c[1] - c[0], c[2] - c[0]));
  }
  return area;
}

/// From a point above, looking down, to a convex closed model: the sum over what faces the point.
double form_factor_from_above(const mesh::Model& model) {
  const Point at{0.2, 0.1, 3.0};
  double sum = 0.0;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    const auto c = corners_of(model, p);
    const std::array<mesh::OutlineEdge, 3> outline{{{c[0], c[1]}, {c[1], c[2]}, {c[2], c[0]}}};
    sum += lighting::point_form_factor(at, Vector{0, 0, -1}, outline, normalized(cross(c[1] - c[0], c[2] - c[0])));
  }
  return sum;
}

/// The order in the size of the triangles, which goes as one by the root of their number.
template <class Quantity>
double order_of(const mesh::Model& cage, const Quantity& quantity) {
  const mesh::Model coarse = support::curved(cage, 4e-3);
  const mesh::Model fine = support::curved(cage, 5e-4);
  const double limit = quantity(support::curved(cage, 3e-5));
  const double ratio = static_cast<double>(fine.polygon_count()) / static_cast<double>(coarse.polygon_count());
  return 2.0 * std::log(std::abs((quantity(coarse) - limit) / (quantity(fine) - limit))) / std::log(ratio);
}

TEST(CurvedSurfaces, TheAreaOfADomeConvergesToSecondOrder) {
  const double order = order_of(dome_cage(), area_of);
  RecordProperty("order", std::to_string(order));
  EXPECT_NEAR(order, 2.0, 0.2);
}

TEST(CurvedSurfaces, TheFormFactorToABallConvergesToSecondOrder) {
  const double order = order_of(support::cube_cage(), form_factor_from_above);
  RecordProperty("order", std::to_string(order));
  EXPECT_NEAR(order, 2.0, 0.2);
}

TEST(CurvedSurfaces, TheSharpEdgeOfADomeStaysInItsPlane) {
  const mesh::Model dome = support::curved(dome_cage(), 1e-3);
  std::size_t below = 0;
  double lowest = 1e9;
  for (const Point& p : dome.vertices) lowest = std::min(lowest, p.z);
  for (std::size_t p = 0; p < dome.polygon_count(); ++p) {
    const auto c = corners_of(dome, p);
    if (dome.polygon_line[p] != 1) continue;
    ++below;
    for (const Point& corner : c) EXPECT_NEAR(corner.z, lowest, 1e-9);
  }
  EXPECT_GT(below, 10U);
}

}  // namespace
}  // namespace clerestory
