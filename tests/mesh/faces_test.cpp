// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/faces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::mesh {
namespace {

using support::area_of;
using support::faces_of;
using support::region_count;
using support::unbalanced_edges;
using support::vertices_on_edges;

Faces faces_from(const Model& model) { return build_faces(clean(model, {})); }

FaceId only_face(const Faces& faces, std::string_view material) {
  const std::vector<FaceId> found = faces_of(faces, material);
  EXPECT_EQ(found.size(), 1U) << material;
  return found.at(0);
}

double total_area(const Faces& faces) {
  double sum = 0.0;
  for (const Face& face : faces.faces) sum += face.area_m2;
  return sum;
}

/// Every quad and triangle fan of the model as triangles.
Model triangulated(const Model& model) {
  Model result;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    const auto loop = model.loop(p);
    const support::Names names{model.material_names[model.polygon_material[p].index()],
                               model.part_names[model.polygon_part[p].index()]};
    for (std::size_t i = 2; i < loop.size(); ++i) {
      support::add_triangle(result, model.vertices[loop[0]], model.vertices[loop[i - 1]], model.vertices[loop[i]],
                            names);
    }
  }
  return result;
}

TEST(Faces, ABoxRoomHasSixWhateverItsTriangles) {
  for (const Model& model : {support::box_room(3, 4, 5), triangulated(support::box_room(3, 4, 5))}) {
    const Faces faces = faces_from(model);
    EXPECT_EQ(faces.count(), 6U);
    EXPECT_EQ(faces.contact_count, 0U);
    EXPECT_NEAR(total_area(faces), 2 * (12.0 + 15.0 + 20.0), 1e-12);
    EXPECT_EQ(faces.shape.vertices.size(), 8U);
    EXPECT_EQ(unbalanced_edges(faces, "room"), 0U);
    for (const Face& face : faces.faces) EXPECT_EQ(face.loops.size(), 1U);
  }
}

TEST(Faces, NormalsLookWhereTheFrontsLook) {
  const Faces faces = faces_from(support::box_room(3, 4, 5));
  EXPECT_NEAR(faces.faces[only_face(faces, "floor").index()].frame.w.z, 1.0, 1e-15);
  EXPECT_NEAR(faces.faces[only_face(faces, "ceiling").index()].frame.w.z, -1.0, 1e-15);
}

TEST(Faces, PolygonsOfOppositeFrontsStayApart) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  support::add_quad(model, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}, {2, 0, 0});
  EXPECT_EQ(faces_from(model).count(), 2U);
}

TEST(Faces, HolesAreHolesHoweverTheyAreGiven) {
  for (const Model& model : {support::square_with_hole(), support::square_with_bridged_hole()}) {
    const Faces faces = faces_from(model);
    ASSERT_EQ(faces.count(), 1U);
    EXPECT_NEAR(faces.faces[0].area_m2, 12.0, 1e-12);
    EXPECT_NEAR(area_of(faces.shape, faces.shape.of(FaceId(0U))), 12.0, 1e-12);
    EXPECT_EQ(faces.faces[0].loops.size(), 2U);
    EXPECT_EQ(region_count(faces.shape, FaceId(0U)), 1U);
  }
}

TEST(Faces, AHoleMayTouchTheOuterLoop) {
  Model model;
  support::add_polygon(model, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {"floor", "floor"},
                       {{{2, 0, 0}, {1, 2, 0}, {2, 3, 0}, {3, 2, 0}}});
  const Faces faces = faces_from(model);
  ASSERT_EQ(faces.count(), 1U);
  EXPECT_NEAR(faces.faces[0].area_m2, 16.0 - 3.0, 1e-12);
  EXPECT_EQ(region_count(faces.shape, FaceId(0U)), 1U);
}

TEST(Faces, SlightlyBentSurfacesDoNotMergeIntoOne) {
  Model model;  // a cylinder of 3600 facets turns by 0.1 degrees at each
  for (int i = 0; i < 40; ++i) {
    const double a = i * 0.1 * std::acos(-1.0) / 180.0;
    const double b = (i + 1) * 0.1 * std::acos(-1.0) / 180.0;
    support::add_quad(model, {10 * std::cos(a), 10 * std::sin(a), 0}, {10 * std::cos(b), 10 * std::sin(b), 0},
                      {10 * std::cos(b), 10 * std::sin(b), 1}, {10 * std::cos(a), 10 * std::sin(a), 1});
  }
  EXPECT_EQ(faces_from(model).count(), 40U);
}

TEST(Contacts, ATableImprintsItsLegsOnTheFloor) {
  const Faces faces = faces_from(support::table_on_floor());
  const FaceId floor = only_face(faces, "floor");
  EXPECT_EQ(region_count(faces.shape, floor), 5U);
  EXPECT_NEAR(faces.faces[floor.index()].area_m2, 16.0, 1e-12);
  EXPECT_EQ(vertices_on_edges(faces), 0U);
  for (const Point& foot : {Point{1.2, 1.6, 0}, Point{2.75, 2.35, 0}}) {
    const Point corner = foot - faces.origin;
    const Point next = corner + Vector{0.05, 0, 0};
    EXPECT_EQ(support::triangles_cut(faces.shape, floor, corner, next), 0U);
  }
  // The heads of the legs on the underside of the top.
  std::size_t regions_of_wood = 0;
  for (const FaceId face : faces_of(faces, "wood")) regions_of_wood += region_count(faces.shape, face);
  EXPECT_EQ(regions_of_wood, 6U + 4U);
}

TEST(Contacts, AWallFromEndToEndDividesTheFloor) {
  const Faces faces = faces_from(support::two_rooms_with_thin_wall());
  EXPECT_EQ(region_count(faces.shape, only_face(faces, "floor")), 2U);
  EXPECT_EQ(region_count(faces.shape, only_face(faces, "ceiling")), 2U);
  EXPECT_EQ(region_count(faces.shape, only_face(faces, "partition")), 1U);
}

TEST(Contacts, AThickWallLeavesItsFootARegion) {
  const Faces faces = faces_from(support::two_rooms_with_thin_wall({.thickness_m = 0.1}));
  EXPECT_EQ(region_count(faces.shape, only_face(faces, "floor")), 3U);
}

TEST(Contacts, AFreeStandingPartitionDoesNotDivideTheFloor) {
  Model model = support::box_room(6, 4, 3);
  support::add_quad(model, {3, 1, 0}, {3, 3, 0}, {3, 3, 2}, {3, 1, 2}, {"partition", "partition"});
  const Faces faces = faces_from(model);
  const FaceId floor = only_face(faces, "floor");
  EXPECT_EQ(region_count(faces.shape, floor), 1U);
  const Point from = Point{3, 1, 0} - faces.origin;
  const Point to = Point{3, 3, 0} - faces.origin;
  EXPECT_EQ(support::triangles_cut(faces.shape, floor, from, to), 0U);
  EXPECT_EQ(faces.contact_count, 1U);
}

TEST(Contacts, HoldAtOddAnglesWithTheSameVerticesOnBothFaces) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(0.0, 6.3);
  std::uniform_real_distribution<double> axis(-1.0, 1.0);
  for (int run = 0; run < 30; ++run) {
    for (const double thickness : {0.0, 0.1}) {
      support::ThinWall wall{thickness, angle(random), {axis(random), axis(random), axis(random)}};
      const Faces faces = faces_from(support::two_rooms_with_thin_wall(wall));
      EXPECT_EQ(region_count(faces.shape, only_face(faces, "floor")), thickness == 0.0 ? 2U : 3U);
      EXPECT_EQ(unbalanced_edges(faces, "room"), 0U);
      EXPECT_EQ(vertices_on_edges(faces), 0U);
      EXPECT_EQ(faces.shape.vertices.size(), thickness == 0.0 ? 12U : 16U);
    }
  }
}

TEST(Contacts, AWallOverTwoSlabsGetsAVertexAtTheirJoint) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {"floor", "one"});
  support::add_quad(model, {2, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {"floor", "two"});
  support::add_quad(model, {1, 1, 0}, {3, 1, 0}, {3, 1, 1}, {1, 1, 1}, {"wall", "wall"});
  const Faces faces = faces_from(model);
  EXPECT_EQ(vertices_on_edges(faces), 0U);
  EXPECT_EQ(faces.contact_count, 2U);
  EXPECT_EQ(faces.faces[only_face(faces, "wall").index()].loops[0].size(), 5U);
}

TEST(Contacts, FacesThatCrossAreCutAlongTheirTrace) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {"floor", "floor"});
  support::add_quad(model, {1, 1, -1}, {3, 2, -1}, {3, 2, 1}, {1, 1, 1}, {"wall", "wall"});
  const Faces faces = faces_from(model);
  const FaceId floor = only_face(faces, "floor");
  const FaceId wall = only_face(faces, "wall");
  const Point from = Point{1, 1, 0} - faces.origin;
  const Point to = Point{3, 2, 0} - faces.origin;
  EXPECT_EQ(support::triangles_cut(faces.shape, floor, from, to), 0U);
  EXPECT_EQ(support::triangles_cut(faces.shape, wall, from, to), 0U);
  EXPECT_EQ(region_count(faces.shape, floor), 1U);
  EXPECT_EQ(region_count(faces.shape, wall), 2U);
  EXPECT_EQ(faces.contact_count, 2U);
  EXPECT_EQ(vertices_on_edges(faces), 0U);
}

TEST(Contacts, ThreeCrossingFacesMeetInOneVertex) {
  Model model;
  support::add_quad(model, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {"a", "a"});
  support::add_quad(model, {-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, {"b", "b"});
  support::add_quad(model, {0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}, {"c", "c"});
  const Faces faces = faces_from(support::rotated(model, {0.4, 0.7, -0.3}, 0.83));
  EXPECT_EQ(faces.shape.vertices.size(), 12U + 6U + 1U);
  for (const char* name : {"a", "b", "c"}) EXPECT_EQ(region_count(faces.shape, only_face(faces, name)), 4U);
  EXPECT_EQ(vertices_on_edges(faces), 0U);
}

TEST(Contacts, CoplanarFacesImprintEachOther) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {"floor", "floor"});
  support::add_quad(model, {1, 1, 0}, {5, 1, 0}, {5, 2, 0}, {1, 2, 0}, {"carpet", "carpet"});
  CleanOptions as_given;
  as_given.repair = CleanOptions::Repair::kOff;
  const Faces faces = build_faces(clean(model, as_given));
  EXPECT_EQ(region_count(faces.shape, only_face(faces, "floor")), 2U);
  EXPECT_EQ(region_count(faces.shape, only_face(faces, "carpet")), 2U);
  EXPECT_EQ(vertices_on_edges(faces), 0U);
}

TEST(Contacts, AGapOfATenthOfAMillimetreIsNoneUnlessItIsClosed) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {"floor", "floor"});
  support::add_quad(model, {1, 1, 1e-4}, {3, 1, 1e-4}, {3, 1, 1}, {1, 1, 1}, {"wall", "wall"});
  CleanOptions as_it_is;
  as_it_is.gap_m = 0.0;
  EXPECT_EQ(build_faces(clean(model, as_it_is)).contact_count, 0U);
  EXPECT_EQ(faces_from(model).contact_count, 1U);  // clean-up closes it
}

TEST(Contacts, ThePaneMeetsTheReveals) {
  CleanOptions options;
  options.sheet_materials = {false, true};
  const Faces faces = build_faces(clean(support::rotated(support::glass_box_in_wall(), {0, 0, 1}, 0.4), options));
  EXPECT_EQ(faces_of(faces, "glass").size(), 1U);
  EXPECT_EQ(faces.contact_count, 4U);
  EXPECT_EQ(vertices_on_edges(faces), 0U);
}

TEST(Contacts, FurnishedRoomsStayClosedAtAnyAngle) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int run = 0; run < 25; ++run) {
    const double width = 4.0 + 6.0 * unit(random);
    const double depth = 3.0 + 6.0 * unit(random);
    Model model = support::box_room(width, depth, 3.0);
    for (int t = 0; t < 4; ++t) {
      const Point corner{(width - 1.6) * unit(random), (depth - 0.8) * unit(random), 0.0};
      support::add_table(model, corner, "table " + std::to_string(t));
    }
    const Vector axis{unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
    const Model turned = support::rotated(triangulated(model), axis, 6.28 * unit(random));
    const Faces faces = faces_from(support::moved(turned, {1e5 * unit(random), -1e5 * unit(random), 0}));
    EXPECT_EQ(unbalanced_edges(faces, "room"), 0U);
    EXPECT_EQ(vertices_on_edges(faces), 0U);
    const FaceId floor = only_face(faces, "floor");
    EXPECT_NEAR(faces.faces[floor.index()].area_m2, width * depth, 1e-6);
    EXPECT_GE(region_count(faces.shape, floor), 5U);
  }
}

TEST(Faces, AreTheSameTwice) {
  const Faces a = faces_from(support::rotated(support::table_on_floor(), {1, 2, 3}, 0.4));
  const Faces b = faces_from(support::rotated(support::table_on_floor(), {1, 2, 3}, 0.4));
  EXPECT_EQ(a.shape.vertices, b.shape.vertices);
  ASSERT_EQ(a.shape.triangles.size(), b.shape.triangles.size());
  for (std::size_t t = 0; t < a.shape.triangles.size(); ++t) {
    EXPECT_EQ(a.shape.triangles[t].vertices, b.shape.triangles[t].vertices);
    EXPECT_EQ(a.shape.triangles[t].region, b.shape.triangles[t].region);
  }
}

TEST(Faces, TakeASurfaceThatWasNotRepaired) {
  CleanOptions off;
  off.repair = CleanOptions::Repair::kOff;
  const Faces faces = build_faces(clean(support::two_rooms_with_thin_wall(), off));
  EXPECT_EQ(unbalanced_edges(faces, "room"), 0U);
  EXPECT_EQ(region_count(faces.shape, only_face(faces, "floor")), 2U);
}

}  // namespace
}  // namespace clerestory::mesh
