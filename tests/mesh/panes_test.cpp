// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/panes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/clean.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

using support::Fronts;

CleanSurface clean_with_glass(const Model& model) {
  CleanOptions options;
  for (const std::string& name : model.material_names) options.sheet_materials.push_back(name == "glass");
  return clean(model, options);
}

double glass_area(const CleanSurface& surface) {
  const Model& m = surface.polygons;
  const Soup soup = to_soup(m);
  double sum = 0.0;
  for (const SoupPolygon& polygon : soup.polygons) {
    if (m.material_names[polygon.material.index()] == "glass") sum += area(soup.points, polygon);
  }
  return sum;
}

/// Least and greatest y of the glass, in model coordinates.
std::pair<double, double> glass_depth(const CleanSurface& surface) {
  const Model& m = surface.polygons;
  std::pair<double, double> range{1e9, -1e9};
  for (std::size_t p = 0; p < m.polygon_count(); ++p) {
    if (m.material_names[m.polygon_material[p].index()] != "glass") continue;
    for (const std::uint32_t corner : m.loop(p)) {
      const double y = m.vertices[corner].y + surface.origin.y;
      range = {std::min(range.first, y), std::max(range.second, y)};
    }
  }
  return range;
}

TEST(Panes, AThinSolidBecomesItsMidSurface) {
  const CleanSurface surface = clean_with_glass(support::glass_box_in_wall(0.024));
  EXPECT_NEAR(glass_area(surface), 2.0 * 1.6, 1e-9);
  EXPECT_NEAR(glass_depth(surface).first, 0.15, 1e-9);
  EXPECT_NEAR(glass_depth(surface).second, 0.15, 1e-9);
  EXPECT_THAT(surface.report.notices,
              testing::ElementsAre("material glass: 1 solid of 24 mm became a pane at its mid-surface"));
}

TEST(Panes, AThickSolidStays) {
  const CleanSurface surface = clean_with_glass(support::glass_box_in_wall(0.12));
  EXPECT_NEAR(glass_area(surface), 2 * (2.0 * 1.6 + 0.12 * (2.0 + 1.6)), 1e-9);
  EXPECT_TRUE(surface.report.notices.empty());
}

TEST(Panes, AreReducedAtAnyAngle) {
  const Model model = support::rotated(support::glass_box_in_wall(0.0239), {0.2, 0.5, 0.8}, 0.937);
  EXPECT_NEAR(glass_area(clean_with_glass(model)), 2.0 * 1.6, 1e-6);
}

TEST(Panes, DoubleAndTripleSheetsBecomeOne) {
  for (const std::size_t sheets : {2U, 3U}) {
    Model model;
    for (std::size_t i = 0; i < sheets; ++i) {
      const double y = 0.02 * static_cast<double>(i);
      support::add_quad(model, {0, y, 0}, {1, y, 0}, {1, y, 2}, {0, y, 2}, {"glass", "window"});
    }
    const CleanSurface surface = clean_with_glass(model);
    EXPECT_NEAR(glass_area(surface), 2.0, 1e-12);
    EXPECT_NEAR(glass_depth(surface).first, 0.01 * static_cast<double>(sheets - 1), 1e-12);
  }
}

TEST(Panes, TwoSolidsWithAGapOfAirBecomeOnePane) {
  Model model;
  support::add_box(model, {0, 0, 0}, {1, 0.004, 1.5}, {"glass", "outer"});
  support::add_box(model, {0, 0.02, 0}, {1, 0.024, 1.5}, {"glass", "inner"});
  const CleanSurface surface = clean_with_glass(model);
  EXPECT_NEAR(glass_area(surface), 1.5, 1e-12);
  EXPECT_NEAR(glass_depth(surface).first, 0.012, 1e-12);
}

TEST(Panes, AreReducedWhenTriangulated) {
  Model model;
  const auto add = [&](const Point& a, const Point& b, const Point& c, const Point& d) {
    support::add_triangle(model, a, b, c, {"glass", "window"});
    support::add_triangle(model, a, c, d, {"glass", "window"});
  };
  Model box;
  support::add_box(box, {0, 0, 0}, {1, 0.01, 1}, {"glass", "window"});
  for (std::size_t p = 0; p < box.polygon_count(); ++p) {
    const auto loop = box.loop(p);
    add(box.vertices[loop[0]], box.vertices[loop[1]], box.vertices[loop[2]], box.vertices[loop[3]]);
  }
  EXPECT_NEAR(glass_area(clean_with_glass(model)), 1.0, 1e-12);
}

TEST(Panes, RimsOfNeighboursAreNoPanes) {
  Model model;
  for (const double x : {0.0, 1.005, 2.01}) {
    support::add_box(model, {x, 0, 0}, {x + 1.0, 0.024, 2}, {"glass", "window"});
  }
  const CleanSurface surface = clean_with_glass(model);
  EXPECT_NEAR(glass_area(surface), 6.0, 1e-12);
  EXPECT_THAT(surface.report.notices,
              testing::ElementsAre("material glass: 3 solids of 24 mm became panes at their mid-surface"));
}

TEST(Panes, ACurtainWallOfButtingSolidsIsOneSheet) {
  Model model;
  for (int i = 0; i < 4; ++i) support::add_box(model, {1.0 * i, 0, 0}, {1.0 * i + 1.0, 0.02, 2}, {"glass", "window"});
  EXPECT_NEAR(glass_area(clean_with_glass(model)), 8.0, 1e-12);
}

TEST(Panes, ARodAndSeparateWindowsStay) {
  Model model;
  support::add_box(model, {0, 0, 0}, {0.05, 0.05, 2}, {"glass", "rod"});
  support::add_quad(model, {1, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, {"glass", "one"});
  support::add_quad(model, {1, 0.5, 0}, {2, 0.5, 0}, {2, 0.5, 1}, {1, 0.5, 1}, {"glass", "other"});
  EXPECT_NEAR(glass_area(clean_with_glass(model)), 2 * 0.05 * 0.05 + 4 * 0.05 * 2 + 2.0, 1e-12);
}

TEST(Panes, OtherMaterialsAreLeftAlone) {
  Model model = support::glass_box_in_wall();
  const CleanSurface surface = clean(model, {});
  EXPECT_NEAR(glass_area(surface), 2 * (2.0 * 1.6 + 0.024 * (2.0 + 1.6)), 1e-9);
}

TEST(Panes, ReductionIsIdempotent) {
  const CleanSurface once = clean_with_glass(support::glass_box_in_wall());
  const CleanSurface twice = clean_with_glass(once.polygons);
  EXPECT_EQ(once.polygons.vertices, twice.polygons.vertices);
  EXPECT_EQ(once.polygons.corners, twice.polygons.corners);
  EXPECT_TRUE(twice.report.notices.empty());
}

}  // namespace
}  // namespace clerestory::mesh
