// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/slits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/clean.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

/// A floor of 4 m × 4 m, and a sheet across it that begins above it.
Faces sheet_over_a_floor(double width_m, double height_m, double rotation_rad = 0.0) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {"floor", "floor"});
  support::add_quad(model, {1, 2, width_m}, {3, 2, width_m}, {3, 2, width_m + height_m}, {1, 2, width_m + height_m},
                    {"wall", "wall"});
  CleanOptions options;
  options.gap_m = 0.0;
  return build_faces(clean(support::rotated(std::move(model), {0.48, -0.6, 0.64}, rotation_rad), options));
}

std::vector<FaceLine> lines_of(const Faces& faces, std::uint8_t has_side = 1) {
  return feet_of(find_slits(faces, std::vector<std::uint8_t>(2 * faces.count(), has_side)));
}

TEST(Slits, TheFootOfASheetThatStopsShortOfAFloorIsALineOfTheFloor) {
  for (const double rotation_rad : {0.0, 0.7}) {
    const Faces faces = sheet_over_a_floor(0.05, 2.5, rotation_rad);
    const std::vector<FaceLine> lines = lines_of(faces);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_NEAR(norm(lines[0].ends[1] - lines[0].ends[0]), 2.0, 1e-9);
    const Face& floor = faces.faces[lines[0].face.index()];
    EXPECT_NEAR(floor.area_m2, 16.0, 1e-9);
    for (const Point& end : lines[0].ends) EXPECT_NEAR(dot(end - floor.origin, floor.frame.w), 0.0, 1e-9);
  }
}

TEST(Slits, ElementsLieOnOneSideOfTheLine) {
  const Faces faces = sheet_over_a_floor(0.05, 2.5);
  const std::vector<FaceLine> lines = lines_of(faces);
  MeshOptions options;
  options.lines = lines;
  const Triangulation mesh = mesh_faces(faces, options);
  const Vector across{0, 1, 0};
  for (const Triangle& t : mesh.of(lines.at(0).face)) {
    Vector to_centre;
    for (const std::uint32_t v : t.vertices) to_centre = to_centre + (mesh.vertices[v] - lines[0].ends[0]) / 3.0;
    for (const std::uint32_t v : t.vertices) {
      const Vector d = mesh.vertices[v] - lines[0].ends[0];
      const double along = std::abs(mesh.vertices[v].x - 0.5 * (lines[0].ends[0].x + lines[0].ends[1].x));
      if (along >= 1.0 - 1e-9) continue;
      EXPECT_GE(dot(d, across) * dot(to_centre, across), -1e-9);
    }
  }
}

TEST(Slits, WideOnesLowThingsAndSidesWithoutElementsGetNoLine) {
  EXPECT_TRUE(lines_of(sheet_over_a_floor(0.12, 2.5)).empty());
  EXPECT_TRUE(lines_of(sheet_over_a_floor(0.05, 0.3)).empty());
  EXPECT_TRUE(lines_of(sheet_over_a_floor(0.05, 2.5), 0).empty());
}

TEST(Slits, WhereTwoFloorsMeetBelowADoorItsFootBelongsToBoth) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}, {"stone", "floor"});
  support::add_quad(model, {0, 2, 0}, {4, 2, 0}, {4, 4, 0}, {0, 4, 0}, {"wood", "floor"});
  support::add_quad(model, {1, 2, 0.05}, {3, 2, 0.05}, {3, 2, 2.5}, {1, 2, 2.5}, {"door", "door"});
  const Faces faces = build_faces(clean(support::rotated(std::move(model), {0.48, -0.6, 0.64}, 0.7), {}));
  const std::vector<Slit> slits = find_slits(faces, std::vector<std::uint8_t>(2 * faces.count(), 1));
  ASSERT_EQ(slits.size(), 2U);
  EXPECT_NE(slits[0].foot.face, slits[1].foot.face);
  for (const Slit& slit : slits) {
    EXPECT_EQ(slit.side, Side::kFront);
    EXPECT_NEAR(slit.width_m, 0.05, 1e-9);
    EXPECT_NEAR(norm(slit.foot.ends[1] - slit.foot.ends[0]), 2.0, 1e-9);
  }
}

}  // namespace
}  // namespace clerestory::mesh
