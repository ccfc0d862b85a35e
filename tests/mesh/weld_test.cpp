// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/weld.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

std::size_t found(std::vector<Defect> defects, std::string_view kind) {
  for (const Defect& defect : defects) {
    if (defect.kind == kind) return defect.found;
  }
  return 0;
}

TEST(Weld, GivesABoxEightVertices) {
  Soup soup = to_soup(support::box_room(3, 4, 5));
  DefectList defects;
  weld(soup, 2e-5, defects);
  EXPECT_EQ(soup.points.size(), 8U);
  const std::vector<Defect> list = std::move(defects).take({});
  EXPECT_EQ(found(list, "duplicate vertices"), 16U);
  EXPECT_EQ(found(list, "near-duplicate vertices"), 0U);
}

TEST(Weld, WorksSixHundredKilometresFromTheOrigin) {
  Soup soup = to_soup(support::moved(support::box_room(3.3, 4.7, 2.9), {612345.123456, 5412345.654321, 517.1}));
  for (std::size_t i = 0; i < soup.points.size(); i += 3) soup.points[i].x += 1e-5;
  DefectList defects;
  weld(soup, 2e-5, defects);
  EXPECT_EQ(soup.points.size(), 8U);
  EXPECT_GT(found(std::move(defects).take({}), "near-duplicate vertices"), 0U);
}

TEST(Weld, KeepsAGapOfATenthOfAMillimetre) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  support::add_quad(model, {1.0001, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1.0001, 1, 0});
  Soup soup = to_soup(model);
  DefectList defects;
  weld(soup, 2e-5, defects);
  EXPECT_EQ(soup.points.size(), 8U);
}

TEST(Weld, LeavesOutPointsOfNoPolygon) {
  Model model = support::facing_squares();
  model.vertices.insert(model.vertices.begin(), Point{0, 0, 0});  // would attract the first corner
  for (std::uint32_t& corner : model.corners) ++corner;
  Soup soup = to_soup(model);
  DefectList defects;
  weld(soup, 2e-5, defects);
  EXPECT_EQ(soup.points.size(), 8U);
  EXPECT_TRUE(std::move(defects).take({}).empty());
}

TEST(ShareVertices, MakesOnlyTheSamePlaceOne) {
  Soup soup = to_soup(support::non_manifold_fan());
  soup.points[4].x += 1e-9;  // a corner on the axis
  share_vertices(soup);
  std::vector<bool> used(soup.points.size(), false);
  for (const SoupPolygon& polygon : soup.polygons) {
    for_each_edge(polygon, [&](std::uint32_t a, std::uint32_t) { used[a] = true; });
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), true), 13);
}

}  // namespace
}  // namespace clerestory::mesh
