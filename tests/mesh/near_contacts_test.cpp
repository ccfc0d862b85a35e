// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/near_contacts.h"

#include <gtest/gtest.h>

#include <utility>

#include "mesh/clean.h"
#include "mesh/faces.h"
#include "mesh/rays.h"
#include "mesh/reachable.h"
#include "mesh/regions.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::mesh {
namespace {

using support::faces_of;

constexpr Vector kAxis{0.48, -0.6, 0.64};

/// A floor of 4 m × 4 m, and a box of 0.8 m × 0.5 m × 1.2 m so far above it, all turned.
Model box_over_a_floor(double gap_m, double rotation_rad = 0.0) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {"floor", "floor"});
  support::add_box(model, {1, 1, gap_m}, {1.8, 1.5, 1.2 + gap_m}, {"wood", "box"});
  return support::rotated(std::move(model), kAxis, rotation_rad);
}

/// Area of the floor's front that light from above reaches [m²].
double lit_area(const Faces& faces) {
  const Rays rays(faces, std::vector<std::uint8_t>(faces.count(), 0));
  const auto sides = reachable_sides(faces, rays, {}, {});
  const auto triangles = reachable_triangles(faces, rays, sides);
  double area = 0.0;
  const FaceId floor = faces_of(faces, "floor").at(0);
  for (std::uint32_t t = faces.shape.starts[floor.index()]; t < faces.shape.starts[floor.index() + 1]; ++t) {
    const auto c = corners(faces, t);
    if (triangles[2 * t] != 0) area += 0.5 * norm(cross(c[1] - c[0], c[2] - c[0]));
  }
  return area;
}

TEST(NearContacts, WhatIsBelowABoxAMillimetreAboveTheFloorIsDark) {
  for (const double gap_m : {7e-5, 2e-4, 1e-3}) {  // what is nearer overlaps, and clean-up cuts the floor
    for (const double rotation_rad : {0.0, 0.3, 1.1}) {
      SCOPED_TRACE(testing::Message() << gap_m << " m, turned by " << rotation_rad);
      const Faces faces = build_faces(clean(box_over_a_floor(gap_m, rotation_rad), {}));
      EXPECT_EQ(faces.count(), 11U);
      EXPECT_EQ(support::region_count(faces.shape, faces_of(faces, "floor").at(0)), 2U);
      EXPECT_NEAR(lit_area(faces), 16.0 - 0.4, 1e-9);
      EXPECT_EQ(support::vertices_on_edges(faces), 0U);
    }
  }
}

TEST(NearContacts, StripsGoDownFromTheSidesAndLookTheirWay) {
  constexpr double kGap = 5e-4;
  const Faces faces = build_faces(clean(box_over_a_floor(kGap), {}));
  double strips_m2 = 0.0;
  for (const FaceId f : faces_of(faces, "wood")) {
    const Face& face = faces.faces[f.index()];
    if (face.area_m2 > 0.01) continue;
    strips_m2 += face.area_m2;
    const Vector outward = face.origin + faces.origin - Point{1.4, 1.25, 0};
    EXPECT_GT(dot(outward, face.frame.w), 0.0);
    EXPECT_EQ(faces.part_names[face.part.index()], "box");
  }
  EXPECT_NEAR(strips_m2, 2.6 * kGap, 1e-9);
}

TEST(NearContacts, WiderGapsAndThoseThatAreToStayAreLeftOpen) {
  EXPECT_EQ(build_faces(clean(box_over_a_floor(2e-3), {})).count(), 7U);
  CleanOptions options;
  options.gap_m = 0.0;
  EXPECT_EQ(build_faces(clean(box_over_a_floor(5e-4), options)).count(), 7U);
  options.gap_m = 3e-3;
  EXPECT_EQ(build_faces(clean(box_over_a_floor(2e-3), options)).count(), 11U);
  options.repair = CleanOptions::Repair::kReport;
  EXPECT_EQ(build_faces(clean(box_over_a_floor(2e-3), options)).count(), 7U);
}

TEST(NearContacts, NothingStandsOnGlassNorOnAnOpening) {
  CleanOptions options;
  options.passable_materials = {true, false};  // floor, wood
  EXPECT_EQ(build_faces(clean(box_over_a_floor(5e-4), options)).count(), 7U);
  options.passable_materials = {false, true};
  EXPECT_EQ(build_faces(clean(box_over_a_floor(5e-4), options)).count(), 7U);
}

TEST(NearContacts, ThingsThatLieOnEachOtherOrCrossGetNoStrips) {
  Model carpet;  // thinner than the gap, exactly on its floor
  support::add_quad(carpet, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {"floor", "floor"});
  support::add_box(carpet, {1, 1, 0}, {3, 2, 8e-4}, {"wool", "carpet"});
  EXPECT_EQ(build_faces(clean(carpet, {})).count(), 7U);
  Model picture;  // a sheet hung before a wall on purpose
  support::add_quad(picture, {0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}, {"wall", "wall"});
  support::add_quad(picture, {1, -5e-4, 1}, {2, -5e-4, 1}, {2, -5e-4, 2}, {1, -5e-4, 2}, {"paper", "picture"});
  EXPECT_EQ(build_faces(clean(picture, {})).count(), 2U);
}

TEST(NearContacts, AFootOverTwoFloorsGetsAStripOnEach) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {2, 0, 0}, {2, 4, 0}, {0, 4, 0}, {"stone", "floor"});
  support::add_quad(model, {2, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 4, 0}, {"wood", "floor"});
  support::add_box(model, {1, 1, 5e-4}, {3, 2, 1}, {"chest", "chest"});
  const Faces faces = build_faces(clean(model, {}));
  double strips_m2 = 0.0;
  std::size_t strips = 0;
  for (const FaceId f : faces_of(faces, "chest")) {
    const double area = faces.faces[f.index()].area_m2;
    if (area > 0.01) continue;
    strips_m2 += area;
    ++strips;
  }
  EXPECT_EQ(strips, 6U);
  EXPECT_NEAR(strips_m2, 6.0 * 5e-4, 1e-9);
  for (const char* floor : {"stone", "wood"})
    EXPECT_EQ(support::region_count(faces.shape, faces_of(faces, floor).at(0)), 2U);
}

}  // namespace
}  // namespace clerestory::mesh
