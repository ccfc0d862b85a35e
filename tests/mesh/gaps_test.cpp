// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/gaps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/clean.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

constexpr double kTolerance = 2e-5;

Soup soup_with(std::initializer_list<Point> corners) {
  Model model;
  support::add_polygon(model, corners);
  return to_soup(model);
}

TEST(Gaps, FollowThePrecisionOfTheCoordinates) {
  EXPECT_DOUBLE_EQ(gap_of_precision(soup_with({{0, 0, 0}, {1.234, 0, 0}, {1, 2.001, 0}}), kTolerance), 0.9e-3);
  EXPECT_DOUBLE_EQ(gap_of_precision(soup_with({{0, 0, 0}, {1.2341, 0, 0}, {1, 2, 0}}), kTolerance), 0.9e-4);
  EXPECT_DOUBLE_EQ(gap_of_precision(soup_with({{0, 0, 0}, {1.0 / 3.0, 0, 0}, {1, 2.0 / 7.0, 0}}), kTolerance),
                   kTolerance);
  EXPECT_DOUBLE_EQ(gap_of_precision(soup_with({{0, 0, 0}, {1.0 / 3.0, 0, 0}, {1000, 2.0 / 7.0, 0}}), kTolerance),
                   1.2e-4);
}

Model two_floors(double gap) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  support::add_quad(model, {1 + gap, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1 + gap, 1, 0});
  return model;
}

TEST(Gaps, AreClosedUpToTheWidthGivenAndNoWider) {
  CleanOptions options;
  options.gap_m = 2e-3;
  EXPECT_NEAR(clean(two_floors(1.9e-3), options).report.area_after_m2, 2.0, 1e-12);
  EXPECT_NEAR(clean(two_floors(2.1e-3), options).report.area_after_m2, 2.0 - 2.1e-3, 1e-12);
  options.gap_m = 0.0;
  EXPECT_NEAR(clean(two_floors(1e-3), options).report.area_after_m2, 2.0 - 1e-3, 1e-12);
}

TEST(Gaps, OfOneMillimetreBesideLongSidesAreClosedUnaskedHoweverTheModelIsTurned) {
  for (const double rotation_rad : {0.0, 0.3}) {
    const Model turned = support::rotated(two_floors(1e-3), {0.48, -0.6, 0.64}, rotation_rad);
    EXPECT_NEAR(clean(turned, {}).report.area_after_m2, 2.0, 1e-9);
    const Model wider = support::rotated(two_floors(2e-3), {0.48, -0.6, 0.64}, rotation_rad);
    EXPECT_NEAR(clean(wider, {}).report.area_after_m2, 2.0 - 2e-3, 1e-9);
  }
}

TEST(Gaps, FineMeshesKeepTheirsUnasked) {
  // Sides of 3 mm: a shift of 0.4 mm would bend them, though the same gap beside long sides is closed.
  const Model small = support::rotated(
      [] {
        Model model;
        support::add_quad(model, {0, 0, 0}, {0.003, 0, 0}, {0.003, 0.003, 0}, {0, 0.003, 0});
        support::add_quad(model, {0.0034, 0, 0}, {0.0064, 0, 0}, {0.0064, 0.003, 0}, {0.0034, 0.003, 0});
        return model;
      }(),
      {0.48, -0.6, 0.64}, 0.3);
  const CleanReport report = clean(small, {}).report;
  EXPECT_TRUE(std::ranges::none_of(report.defects, [](const Defect& d) { return d.kind == "gaps"; }));
}

TEST(Gaps, SolidsDoNotMove) {
  Model model;
  support::add_box(model, {0, 0, 0}, {1, 1, 1});
  support::add_box(model, {1.001, 0, 0}, {2, 1, 1});
  CleanOptions options;
  options.gap_m = 2e-3;
  const CleanSurface surface = clean(model, options);
  EXPECT_TRUE(std::none_of(surface.report.defects.begin(), surface.report.defects.end(),
                           [](const Defect& d) { return d.kind == "gaps"; }));
}

TEST(Gaps, AWallIsDrawnToTheFloorThatItStandsOver) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {"floor", "floor"});
  support::add_quad(model, {1, 2, 0.001}, {3, 2, 0.001}, {3, 2, 3}, {1, 2, 3}, {"wall", "wall"});
  CleanOptions options;
  options.gap_m = 2e-3;
  EXPECT_NEAR(clean(model, options).report.area_after_m2, 16.0 + 6.0, 1e-12);
}

}  // namespace
}  // namespace clerestory::mesh
