// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/clean.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesh/error.h"
#include "mesh/soup.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

const Defect* find(const CleanReport& report, std::string_view kind) {
  const auto found =
      std::find_if(report.defects.begin(), report.defects.end(), [&](const Defect& d) { return d.kind == kind; });
  return found == report.defects.end() ? nullptr : &*found;
}

/// What a rough export of a furnished office may hold.
Model rough_office() {
  Model model = support::two_rooms_with_thin_wall();
  support::add_table(model, {0.7, 1.1, 0.0});
  support::append(model, support::moved(support::l_room(), {10, 0, 0}));
  support::add_quad(model, {0, 0, 0}, {6, 0, 0}, {6, 0, 3}, {0, 0, 3}, {"wall", "copy"});  // lies on the front wall
  support::add_triangle(model, {1, 1, 1}, {2, 1, 1}, {3, 1, 1}, {"metal", "needle"});
  support::add_quad(model, {7, 0, 0}, {8, 0, 0}, {8, 1, 0.3}, {7, 1, 0}, {"wood", "warped"});
  return model;
}

TEST(Clean, FindsAndMendsWhatIsWrong) {
  const Model model = rough_office();
  const CleanSurface surface = clean(model, {});
  for (const char* kind :
       {"duplicate vertices", "T-junctions", "degenerate polygons", "duplicate polygons", "non-planar polygons"}) {
    const Defect* defect = find(surface.report, kind);
    ASSERT_NE(defect, nullptr) << kind;
    EXPECT_GT(defect->found, 0U) << kind;
    EXPECT_EQ(defect->found, defect->mended) << kind;
    EXPECT_FALSE(defect->places.empty()) << kind;
  }
  EXPECT_EQ(find(surface.report, "degenerate polygons")->places[0].polygon, model.polygon_count() - 2);
}

TEST(Clean, IsIdempotent) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-1.2e-5, 1.2e-5);
  for (int run = 0; run < 60; ++run) {
    Model model = support::rotated(rough_office(), {0.3, 0.1, 1.0}, 0.37 * run);
    for (Point& p : model.vertices) p = p + Vector{noise(random), noise(random), noise(random)};
    const CleanSurface once = clean(model, {});
    const CleanSurface twice = clean(once.polygons, {});
    for (const Defect& defect : twice.report.defects) EXPECT_EQ(defect.mended, 0U) << defect.kind;
    EXPECT_EQ(once.polygons.vertices, twice.polygons.vertices);
    EXPECT_EQ(once.polygons.corners, twice.polygons.corners);
    EXPECT_EQ(norm(twice.origin), 0.0);
  }
}

TEST(Clean, GivesTheSamePlacesAwayFromTheOrigin) {
  const Vector offset{612345.125, 5412345.625, 517.0};
  const CleanSurface here = clean(rough_office(), {});
  const CleanSurface there = clean(support::moved(rough_office(), offset), {});
  ASSERT_EQ(here.polygons.vertices.size(), there.polygons.vertices.size());
  EXPECT_EQ(here.polygons.corners, there.polygons.corners);
  for (std::size_t i = 0; i < here.polygons.vertices.size(); ++i) {
    const Point a = here.polygons.vertices[i] + here.origin + offset;
    const Point b = there.polygons.vertices[i] + there.origin;
    EXPECT_LT(norm(a - b), 2e-9);
  }
  EXPECT_EQ(there.origin.x, std::floor(there.origin.x));
}

TEST(Clean, KeepsAreaAndSource) {
  const Model model = support::l_room();
  const CleanSurface surface = clean(model, {});
  const double area_m2 = 2 * 12.0 + 16.0 * 3.0;
  EXPECT_NEAR(surface.report.area_before_m2, area_m2, 1e-12);
  EXPECT_NEAR(surface.report.area_after_m2, area_m2, 1e-12);
  EXPECT_THAT(surface.source, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
}

TEST(Clean, CountsTheAreaOfBridgedHolesRight) {
  EXPECT_NEAR(clean(support::square_with_hole(), {}).report.area_before_m2, 12.0, 1e-12);
  const CleanReport bridged = clean(support::square_with_bridged_hole(), {}).report;
  EXPECT_NEAR(bridged.area_before_m2, 12.0, 1e-12);
  EXPECT_NEAR(bridged.area_after_m2, 12.0, 1e-12);
}

TEST(Clean, ReportsAloneWhenAsked) {
  CleanOptions options;
  options.repair = CleanOptions::Repair::kReport;
  const Model model = rough_office();
  const CleanSurface surface = clean(model, options);
  const CleanSurface mended = clean(model, {});
  ASSERT_EQ(surface.report.defects.size(), mended.report.defects.size());
  for (std::size_t i = 0; i < surface.report.defects.size(); ++i) {
    EXPECT_EQ(surface.report.defects[i].found, mended.report.defects[i].found);
    EXPECT_EQ(surface.report.defects[i].mended, 0U);
  }
  EXPECT_EQ(surface.polygons.polygon_count(), model.polygon_count() - 1);  // less the one without a plane
}

TEST(Clean, OffMovesTheOriginAlone) {
  CleanOptions options;
  options.repair = CleanOptions::Repair::kOff;
  Model model = support::facing_squares();
  model.vertices[1].x += 1e-6;
  const CleanSurface surface = clean(support::moved(model, {1000, 2000, 0}), options);
  EXPECT_TRUE(surface.report.defects.empty());
  EXPECT_EQ(surface.polygons.vertices.size(), 8U);
  EXPECT_EQ(surface.origin.x, 1001.0);
}

TEST(Clean, LeavesOutPartsFarAwayAndSaysSo) {
  Model model = rough_office();
  support::add_box(model, {50'000, 0, 0}, {50'001, 1, 1}, {"wood", "stray"});
  const CleanSurface surface = clean(model, {});
  EXPECT_THAT(surface.report.notices, testing::ElementsAre(testing::HasSubstr("part stray lies 50.0 km from")));
  EXPECT_LT(norm(surface.origin), 20.0);
  Model near = rough_office();
  support::add_box(near, {500, 0, 0}, {501, 1, 1}, {"wood", "neighbour"});
  EXPECT_TRUE(clean(near, {}).report.notices.empty());
}

TEST(Clean, RefusesAModelOfWhichNothingIsLeft) {
  Model model;
  EXPECT_THROW(clean(model, {}), InputError);
  support::add_triangle(model, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  EXPECT_THROW(clean(model, {}), InputError);
}

TEST(Clean, GivesTheSameAnswerTwice) {
  const CleanSurface a = clean(rough_office(), {});
  const CleanSurface b = clean(rough_office(), {});
  EXPECT_EQ(a.polygons.vertices, b.polygons.vertices);
  EXPECT_EQ(a.polygons.corners, b.polygons.corners);
}

}  // namespace
}  // namespace clerestory::mesh
