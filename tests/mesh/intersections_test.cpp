// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/intersections.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh/clean.h"
#include "mesh/polygon_pairs.h"
#include "mesh/weld.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

std::vector<PolygonPair> pairs_of(const Model& model) {
  Soup soup = to_soup(model);
  share_vertices(soup);
  return find_polygon_pairs(soup, 2e-5);
}

double area_of(const CleanSurface& surface, std::string_view material) {
  const Soup soup = to_soup(surface.polygons);
  double sum = 0.0;
  for (const SoupPolygon& p : soup.polygons) {
    if (surface.polygons.material_names[p.material.index()] == material) sum += area(soup.points, p);
  }
  return sum;
}

TEST(PolygonPairs, NeighboursAndTouchingThingsAreNone) {
  Model model = support::l_room();
  support::append(model, support::moved(support::non_manifold_fan(), {20, 0, 0}));
  support::append(model, support::moved(support::shelf(), {30, 0, 0}));
  support::append(model, support::moved(support::table_on_floor(), {40, 0, 0}));
  EXPECT_TRUE(pairs_of(model).empty());
}

TEST(PolygonPairs, ThreeTenthsOfATenthOfAMillimetreAreNoCrossing) {
  for (const double depth : {5e-5, 7e-5}) {
    Model model;
    support::add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0});
    support::add_quad(model, {1, 1, -depth}, {3, 1, -depth}, {3, 1, 2}, {1, 1, 2});
    EXPECT_EQ(pairs_of(model).size(), depth > 6e-5 ? 1U : 0U) << depth;
  }
}

TEST(Intersections, TheSmallerSurfaceStaysWhateverTheOrder) {
  for (const bool carpet_first : {true, false}) {
    Model floor;
    support::add_quad(floor, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {"floor", "floor"});
    Model carpet;
    support::add_quad(carpet, {3, 3, 0}, {3, 5, 0}, {5, 5, 0}, {5, 3, 0}, {"carpet", "carpet"});
    Model model = carpet_first ? carpet : floor;
    support::append(model, carpet_first ? floor : carpet);
    const CleanSurface surface = clean(model, {});
    EXPECT_NEAR(area_of(surface, "carpet"), 4.0, 1e-12);
    EXPECT_NEAR(area_of(surface, "floor"), 15.0, 1e-12);
  }
}

TEST(Intersections, OfTheSameSizeTheEarlierStays) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {"first", "first"});
  support::add_quad(model, {1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}, {"second", "second"});
  const CleanSurface surface = clean(model, {});
  EXPECT_NEAR(area_of(surface, "first"), 4.0, 1e-12);
  EXPECT_NEAR(area_of(surface, "second"), 3.0, 1e-12);
}

TEST(Intersections, BoxesAtRandomKeepAreaAndStayClosed) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(0.0, 2.0);
  std::uniform_real_distribution<double> size(0.4, 1.5);
  std::uniform_real_distribution<double> angle(0.0, 3.0);
  for (int run = 0; run < 40; ++run) {
    Model model;
    for (int b = 0; b < 4; ++b) {
      Model box;
      support::add_box(box, {0, 0, 0}, {size(random), size(random), size(random)}, {"wall", "box" + std::to_string(b)});
      box = support::rotated(box, {place(random), place(random), 1.0}, angle(random));
      support::append(model, support::moved(box, {place(random), place(random), place(random)}));
    }
    const CleanSurface once = clean(model, {});
    EXPECT_NEAR(once.report.area_after_m2, once.report.area_before_m2, 1e-6 * once.report.area_before_m2) << run;
    EXPECT_EQ(once.report.open_edges, 0U) << run;
    Soup cleaned = to_soup(once.polygons);
    EXPECT_TRUE(find_polygon_pairs(cleaned, 2e-5).empty()) << run;
  }
}

TEST(Intersections, GridsOfCarpetsCoverOneArea) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {"floor", "floor"});
  for (int i = 0; i < 9; ++i) {
    const double x = 0.4 + i;
    support::add_quad(model, {x, 0.5, 0}, {x + 0.7, 0.5, 0}, {x + 0.7, 9.5, 0}, {x, 9.5, 0},
                      {"carpet", "strip" + std::to_string(i)});
    support::add_quad(model, {0.5, x, 0}, {9.5, x, 0}, {9.5, x + 0.7, 0}, {0.5, x + 0.7, 0},
                      {"runner", "runner" + std::to_string(i)});
  }
  const CleanSurface surface = clean(support::rotated(model, {0.3, 0.4, 0.5}, 0.7), {});
  EXPECT_NEAR(surface.report.area_after_m2, 100.0, 1e-4);
}

}  // namespace
}  // namespace clerestory::mesh
