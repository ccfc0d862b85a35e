// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/grids.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "lighting/grid_layout.h"
#include "mesh/clean.h"
#include "mesh/error.h"
#include "mesh/reachable.h"
#include "tests/support/places.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;
using support::add_box;
using support::add_quad;
using testing::HasSubstr;

/// A model made ready for sensors, with point sources in it.
struct Site {
  explicit Site(const mesh::Model& model, std::vector<Point> lamps = {})
      : faces(mesh::build_faces(mesh::clean(model, {}))), rays(faces) {
    for (Point& lamp : lamps) lamp = lamp - faces.origin;
    reachable = mesh::reachable_triangles(faces, rays, mesh::reachable_sides(faces, rays, {}, lamps));
    rooms = mesh::find_rooms(faces, rays, {.reached = reachable});
  }
  /// Sensors in model coordinates.
  [[nodiscard]] Sensors place(const GridRequest& request) const {
    std::vector<std::string> unread;
    Sensors sensors = place_sensors(request, {faces, rays, reachable, rooms}, unread).at(0).sensors;
    for (Point& p : sensors.positions) p = p + faces.origin;
    for (auto& cell : sensors.cells) {
      for (Point& p : cell) p = p + faces.origin;
    }
    for (auto& loop : sensors.outlines) {
      for (Point& p : loop) p = p + faces.origin;
    }
    return sensors;
  }
  /// One grid a room, local coordinates.
  std::vector<NamedSensors> place_by_room(double spacing_m, std::optional<double> margin_m = {}) {
    GridRequest request;
    request.surfaces = {"rooms"};
    request.spacing_m = spacing_m;
    request.margin_m = margin_m;
    request.by_room = true;
    return place_sensors(request, {faces, rays, reachable, rooms}, notices);
  }
  [[nodiscard]] std::string refusal(const GridRequest& request) const {
    try {
      std::ignore = place(request);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }

  mesh::Faces faces;
  mesh::Rays rays;
  std::vector<std::uint8_t> reachable;
  mesh::Rooms rooms;
  std::vector<std::string> notices;
};

GridRequest on(const std::string& surface, double spacing_m = 0.25, std::optional<double> margin_m = 0.0) {
  GridRequest request;
  request.surfaces = {surface};
  request.spacing_m = spacing_m;
  request.margin_m = margin_m;
  return request;
}

GridRequest given(std::vector<Point> points) {
  GridRequest request;
  request.normals.assign(points.size(), Vector{0, 0, 1});
  request.points = std::move(points);
  return request;
}

void expect_near(const Point& a, const Point& b) {
  EXPECT_NEAR(a.x, b.x, 1e-6);
  EXPECT_NEAR(a.y, b.y, 1e-6);
  EXPECT_NEAR(a.z, b.z, 1e-6);
}

double area_of(const std::vector<Point>& loop) {
  Vector sum;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    sum = sum + mesh::cross(loop[i] - loop[0], loop[(i + 1) % loop.size()] - loop[0]);
  }
  return 0.5 * mesh::norm(sum);
}

TEST(Grid, RoomOfSixByEightGetsCellCentresXFirst) {
  const Sensors s = Site(support::box_room(6, 8, 3)).place(on("rooms"));
  ASSERT_EQ(s.count(), 24U * 32U);
  for (std::size_t i = 0; i < s.count(); ++i) {
    expect_near(s.positions[i],
                {0.125 + 0.25 * static_cast<double>(i % 24), 0.125 + 0.25 * static_cast<double>(i / 24), 0.8});
    EXPECT_EQ(s.normals[i].z, 1.0);
  }
  expect_near(s.cells[0][0], {0, 0, 0.8});
  expect_near(s.cells[0][2], {0.25, 0.25, 0.8});
  ASSERT_EQ(s.outlines.size(), 1U);
  EXPECT_EQ(s.outlines[0].size(), 4U);
  EXPECT_NEAR(area_of(s.outlines[0]), 48.0, 1e-9);
  EXPECT_EQ(s.left_out, 0U);
  EXPECT_EQ(s.ids.size(), s.count());
  EXPECT_EQ(s.ids.back(), s.count() - 1);
}

TEST(Grid, NamedFloorEqualsTheRoom) {
  const Site site(support::box_room(6, 8, 3), {{3, 4, 2.5}});
  const Sensors rooms = site.place(on("rooms"));
  const Sensors floor = site.place(on("fl*"));
  ASSERT_EQ(rooms.count(), floor.count());
  for (std::size_t i = 0; i < rooms.count(); ++i) EXPECT_EQ(rooms.positions[i], floor.positions[i]);
}

TEST(Grid, FloorWoundDownwardsIsLookedUponFromAbove) {
  mesh::Model model;
  add_quad(model, {0, 0, 0}, {0, 4, 0}, {6, 4, 0}, {6, 0, 0}, {"floor", "floor"});
  const Sensors s = Site(model).place(on("floor", 1.0));
  ASSERT_EQ(s.count(), 24U);
  expect_near(s.positions[0], {0.5, 0.5, 0.8});
  EXPECT_EQ(s.normals[0].z, 1.0);
}

TEST(Grid, AutomaticMarginIsFifteenPerCentAndAtMostHalfAMetre) {
  const Sensors small = Site(support::box_room(2, 3, 3)).place(on("rooms", 0.1, std::nullopt));
  EXPECT_EQ(small.count(), 14U * 24U);  // 2 - 0.6 by 3 - 0.6
  expect_near(small.cells[0][0], {0.3, 0.3, 0.8});
  const Sensors large = Site(support::box_room(6, 8, 3)).place(on("rooms", 0.25, std::nullopt));
  EXPECT_EQ(large.count(), 20U * 28U);
  expect_near(large.cells[0][0], {0.5, 0.5, 0.8});
}

TEST(Grid, SpacingAdaptsToFillTheLength) {
  const Sensors s = Site(support::box_room(5, 3.1, 3)).place(on("rooms", 0.8));
  ASSERT_EQ(s.count(), 6U * 4U);
  expect_near(s.cells.back()[2], {5, 3.1, 0.8});
}

TEST(Grid, StandardSpacingFollowsTheLongerSide) {
  EXPECT_NEAR(en12464_spacing_m(10, 6), 1.0, 1e-12);
  EXPECT_NEAR(en12464_spacing_m(1, 1), 0.2, 1e-12);
  EXPECT_NEAR(en12464_spacing_m(10, 5), en12464_spacing_m(5, 5), 1e-12) << "ratio of two: the shorter side";
  EXPECT_NEAR(en12464_spacing_m(10, 100), 1.0, 1e-12);
  EXPECT_NEAR(en12464_spacing_m(1e6, 0.9e6), 10.0, 1e-12);
  GridRequest request = on("rooms");
  request.en12464_spacing = true;
  const Sensors s = Site(support::box_room(10, 6, 3)).place(request);
  EXPECT_EQ(s.count(), 60U);
}

TEST(Grid, TurnedRoomGetsATurnedGrid) {
  const double angle = 0.4;
  const auto turned = support::rotated(support::box_room(6, 8, 3), {0, 0, 1}, angle);
  const Sensors s = Site(turned).place(on("rooms", 0.5));
  ASSERT_EQ(s.count(), 12U * 16U);
  const auto at = [&](double x, double y) {
    return Point{x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle), 0.8};
  };
  expect_near(s.positions[0], at(0.25, 0.25));
  expect_near(s.positions[1], at(0.75, 0.25));
  expect_near(s.positions[12], at(0.25, 0.75));
}

TEST(Grid, LRoomHasSensorsInItsLegsAlone) {
  const Sensors s = Site(support::l_room()).place(on("rooms", 0.25, 0.3));
  std::size_t beyond_notch = 0;
  for (const Point& p : s.positions) {
    EXPECT_TRUE(p.x < 2.0 || p.y < 2.0) << p.x << ' ' << p.y;
    const double to_notch = std::hypot(std::max(0.0, 2.0 - p.x), std::max(0.0, 2.0 - p.y));
    EXPECT_GE(std::max({to_notch, 0.0}), 0.3 - 1e-6);
    if (p.x > 2.0 || p.y > 2.0) ++beyond_notch;
  }
  EXPECT_GT(beyond_notch, 0U);
  ASSERT_EQ(s.outlines.size(), 1U);
  EXPECT_EQ(s.outlines[0].size(), 6U);
  EXPECT_NEAR(area_of(s.outlines[0]), 12.0, 1e-9);
}

TEST(Grid, ThinWallMakesTwoRooms) {
  const Site site(support::two_rooms_with_thin_wall({.thickness_m = 0.1}), {{1.5, 2, 2}, {4.5, 2, 2}});
  const Sensors s = site.place(on("rooms", 0.5));
  EXPECT_EQ(s.outlines.size(), 2U);
  EXPECT_EQ(s.count(), 2U * 6U * 8U);
  EXPECT_EQ(s.left_out, 0U);
  for (const Point& p : s.positions) EXPECT_GT(std::abs(p.x - 3.0), 0.05);
  EXPECT_EQ(Site(support::two_rooms_with_thin_wall(), {{1, 2, 2}, {5, 2, 2}}).place(on("rooms")).outlines.size(), 2U);
}

TEST(Grid, DarkRoomBesideALitOneIsNotTakenForASolid) {
  const Site site(support::two_rooms_with_thin_wall({.thickness_m = 0.1}), {{1.5, 2, 2}});
  const Sensors s = site.place(given({{1, 1, 0.8}, {5, 1, 0.8}, {5.9, 3.9, 0.1}, {3.0, 2, 0.8}}));
  EXPECT_EQ(s.left_out, 1U);
  EXPECT_THAT(s.ids, testing::ElementsAre(0, 1, 2));
}

TEST(Grid, FloorOfTwoMaterialsIsOneRoom) {
  mesh::Model model = support::box_room(6, 4, 3);
  mesh::Model two;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    std::vector<Point> outer;
    for (const std::uint32_t c : model.loop(p)) outer.push_back(model.vertices[c]);
    const std::string material = model.material_names[model.polygon_material[p].index()];
    if (material != "floor") support::add_polygon(two, outer, {material, "room"});
  }
  add_quad(two, {0, 0, 0}, {2.2, 0, 0}, {2.2, 4, 0}, {0, 4, 0}, {"wood", "a"});
  add_quad(two, {2.2, 0, 0}, {6, 0, 0}, {6, 4, 0}, {2.2, 4, 0}, {"carpet", "b"});
  const Sensors one = Site(two).place(on("rooms", 0.5));
  EXPECT_EQ(one.outlines.size(), 1U);
  EXPECT_EQ(one.count(), 12U * 8U);
  add_quad(two, {2.2, 0, 0}, {2.2, 4, 0}, {2.2, 4, 3}, {2.2, 0, 3}, {"wall", "divider"});
  EXPECT_EQ(Site(two).place(on("rooms", 0.5)).outlines.size(), 2U);
}

/// Light reaches the slab over the joint along a wall, and what lies below the screed by the gap under it.
TEST(Grid, RoomsStandOnTheUpperLayerOfTheirFloor) {
  for (const double gap_m : {0.0, 0.013}) {
    mesh::Model model = support::box_room(6, 4, 3);
    add_box(model, {0, 0, gap_m}, {5.97, 4, gap_m + 0.02}, {"screed", "screed"});
    const Sensors s = Site(model, {{1, 1, 2.5}}).place(on("rooms", 0.5));
    EXPECT_EQ(s.outlines.size(), 1U) << gap_m;
    EXPECT_EQ(s.count(), 12U * 8U) << gap_m;
    for (const Point& p : s.positions) EXPECT_NEAR(p.z, gap_m + 0.02 + 0.8, 1e-6);
  }
}

TEST(Grid, TablesAreNeitherRoomsNorHoles) {
  mesh::Model model = support::box_room(6, 4, 3);
  support::add_table(model, {2, 1, 0});
  add_box(model, {3.5, 0.5, 0.70}, {5.5, 2.5, 0.74}, {"wood", "large table"});
  add_box(model, {4.4, 1.4, 0}, {4.6, 1.6, 0.70}, {"metal", "its leg"});
  const Sensors s = Site(model, {{1, 1, 2.5}}).place(on("rooms", 0.5));
  EXPECT_EQ(s.outlines.size(), 1U);
  EXPECT_EQ(s.count(), 12U * 8U);
  for (const Point& p : s.positions) EXPECT_NEAR(p.z, 0.8, 1e-9);
}

TEST(Grid, BedOfTwoSquareMetresIsNoRoom) {
  mesh::Model model = support::box_room(6, 4, 3);
  add_box(model, {2, 1, 0}, {4, 3, 0.5}, {"fabric", "bed"});
  const Sensors s = Site(model, {{1, 1, 2.5}}).place(on("rooms", 0.5));
  EXPECT_EQ(s.outlines.size(), 1U);
  EXPECT_EQ(s.count(), 12U * 8U);
}

TEST(Grid, TopOfAHighBlockIsNoRoom) {
  mesh::Model model = support::box_room(6, 6, 6);
  add_box(model, {2, 2, 0}, {4, 4, 3}, {"concrete", "block"});
  const Sensors s = Site(model, {{1, 1, 5}}).place(on("rooms", 0.5));
  for (const Point& p : s.positions) EXPECT_NEAR(p.z, 0.8, 1e-9);
  EXPECT_EQ(s.count(), 144U - 16U);
}

TEST(Grid, GalleryOnAWallIsARoom) {
  mesh::Model model = support::box_room(6, 6, 6);
  add_box(model, {0, 0, 3}, {6, 2, 3.2}, {"concrete", "gallery"});
  const Sensors s = Site(model, {{3, 4, 5}}).place(on("rooms", 0.5));
  EXPECT_EQ(s.outlines.size(), 2U);
  EXPECT_EQ(s.count(), 144U + 48U);
}

TEST(Grid, LowCupboardAtTheWallIsPartOfTheRoom) {
  mesh::Model model = support::box_room(6, 4, 3);
  add_box(model, {0, 0, 0}, {0.5, 4, 0.7}, {"wood", "cupboard"});
  const Sensors s = Site(model, {{3, 1, 2.5}}).place(on("rooms", 0.5));
  EXPECT_EQ(s.count(), 12U * 8U);
  EXPECT_EQ(Site(model, {{3, 1, 2.5}}).place(on("floor", 0.5)).count(), 12U * 8U);
}

TEST(Grid, SensorsInAColumnAreLeftOutAndCounted) {
  for (const bool standing_on_floor : {true, false}) {
    mesh::Model model = support::box_room(6, 4, 3);
    const double low = standing_on_floor ? 0.0 : 0.01;
    add_box(model, {2.0, 1.0, low}, {2.5, 1.5, 3}, {"concrete", "column"});
    for (const std::string surface : {"rooms", "floor"}) {
      const Sensors s = Site(model, {{5, 3, 2.5}}).place(on(surface, 0.25));
      EXPECT_EQ(s.left_out, 4U);
      EXPECT_EQ(s.count(), 24U * 16U - 4U);
      EXPECT_EQ(s.cells.size(), s.count());
      EXPECT_EQ(s.ids.back(), s.count() - 1);
    }
  }
}

TEST(Grid, FreeStandingPartitionDoesNotMoveTheMargin) {
  mesh::Model model = support::box_room(6, 4, 3);
  add_box(model, {2.05, 0.5, 0}, {2.15, 2.5, 1.5}, {"fabric", "partition"});
  const Sensors s = Site(model, {{5, 3, 2.5}}).place(on("rooms", 0.5, std::nullopt));
  EXPECT_EQ(s.count() + s.left_out, 10U * 6U);
}

/// A building of two storeys with slabs and walls as solids, a wall left out at y = 0, and ground.
mesh::Model two_storeys() {
  mesh::Model model;
  add_quad(model, {-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}, {"ground", "ground"});
  for (const int storey : {0, 1, 2}) {
    const double z = 3.0 * storey;
    add_box(model, {0, 0, z}, {6, 8, z + 0.3}, {"concrete", storey == 2 ? "roof" : "slab"});
    if (storey == 2) break;
    add_box(model, {0, 0, z + 0.3}, {0.2, 8, z + 3.0}, {"plaster", "west"});
    add_box(model, {5.8, 0, z + 0.3}, {6, 8, z + 3.0}, {"plaster", "east"});
    add_box(model, {0.2, 7.8, z + 0.3}, {5.8, 8, z + 3.0}, {"plaster", "north"});
    add_box(model, {2, 3, z + 1.0}, {4.4, 4.2, z + 1.05}, {"wood", "table"});
  }
  return model;
}

TEST(Grid, EachStoreyIsARoomAndTheRoofTheGroundAndTheSlabsInsidesAreNone) {
  const Sensors s = Site(two_storeys()).place(on("rooms", 0.2, 0.0));
  ASSERT_EQ(s.outlines.size(), 2U);
  std::set<double> heights;
  for (const Point& p : s.positions) heights.insert(std::round(p.z * 1e6) / 1e6);
  EXPECT_THAT(heights, testing::ElementsAre(1.1, 4.1));
  EXPECT_NEAR(area_of(s.outlines[0]), 5.6 * 7.8, 1e-6);
}

TEST(Grid, SlabGivesItsUpperSideInsideTheRoomAlone) {
  const Sensors s = Site(two_storeys()).place(on("slab", 0.2, 0.0));
  std::set<double> heights;
  for (const Point& p : s.positions) heights.insert(std::round(p.z * 1e6) / 1e6);
  EXPECT_THAT(heights, testing::ElementsAre(1.1, 4.1));
}

TEST(Grid, WallsLookIntoTheRoom) {
  GridRequest request = on("west", 0.5);
  request.height_m = 0.1;
  const Sensors s = Site(two_storeys()).place(request);
  ASSERT_GT(s.count(), 0U);
  for (std::size_t i = 0; i < s.count(); ++i) {
    EXPECT_NEAR(s.normals[i].x, 1.0, 1e-12);
    EXPECT_NEAR(s.positions[i].x, 0.3, 1e-9);
    EXPECT_LT(s.positions[i].y, 7.8);
  }
  request.surfaces = {"wall"};
  const Sensors inside = Site(support::box_room(6, 4, 3)).place(request);
  EXPECT_EQ(inside.outlines.size(), 4U);
  EXPECT_EQ(inside.count(), 2U * 12U * 6U + 2U * 8U * 6U);
  for (std::size_t i = 0; i < inside.count(); ++i) {
    EXPECT_GT(mesh::dot(Point{3, 2, 1.5} - inside.positions[i], inside.normals[i]), 0.0);
  }
}

TEST(Grid, GivenPointsInRowsGetCellsAndKeepTheirOrder) {
  std::vector<Point> points;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 4; ++i) points.push_back({1.0 + 0.333 * i, 1.0 + 0.25 * j, 0.85});
  }
  const Site site(support::box_room(6, 8, 3));
  const Sensors s = site.place(given(points));
  ASSERT_EQ(s.count(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) expect_near(s.positions[i], points[i]);
  ASSERT_EQ(s.cells.size(), points.size());
  expect_near(s.cells[5][0], {1.333 - 0.1665, 1.25 - 0.125, 0.85});
  expect_near(s.cells[5][2], {1.333 + 0.1665, 1.25 + 0.125, 0.85});
  points[7].x += 0.1;
  EXPECT_TRUE(site.place(given(points)).cells.empty());
  EXPECT_TRUE(site.place(given({{1, 1, 1}})).cells.empty());
}

TEST(Grid, AnUnknownNameIsRefusedWithItsNeighbours) {
  const std::string text = Site(support::box_room(6, 8, 3)).refusal(on("flor"));
  EXPECT_THAT(text, HasSubstr("'flor'"));
  EXPECT_THAT(text, HasSubstr("'floor'"));
}

TEST(Grid, AMarginLargerThanTheRoomIsRefused) {
  const std::string text = Site(support::box_room(6, 8, 3)).refusal(on("rooms", 0.25, 5.0));
  EXPECT_THAT(text, HasSubstr("grid 'workplane'"));
  EXPECT_THAT(text, HasSubstr("margin of 5 m"));
  EXPECT_THAT(text, HasSubstr("6 x 8 m"));
}

TEST(Grid, AGridInsideAWallIsRefused) {
  const Site site(two_storeys());
  std::vector<Point> points;
  for (int i = 0; i < 12; ++i) points.push_back({0.1, 1.0 + 0.5 * i, 1.5});
  EXPECT_THAT(site.refusal(given(points)), HasSubstr("all 12 sensors lie inside solids"));
}

TEST(Grid, ASpacingOfMillionsOfCellsIsRefused) {
  EXPECT_THAT(Site(support::box_room(6, 8, 3)).refusal(on("rooms", 1e-4)), HasSubstr("larger spacing"));
}

/// Two rooms of 3 m x 4 m x 3 m with a wall of 0.2 m between, and in it a doorway of 0.9 m x 2.1 m. One floor for all.
mesh::Model rooms_with_open_door() {
  mesh::Model model = support::box_room(6.2, 4, 3);
  add_box(model, {3, 0, 0}, {3.2, 1, 3}, {"plaster", "partition"});
  add_box(model, {3, 1.9, 0}, {3.2, 4, 3}, {"plaster", "partition"});
  add_box(model, {3, 1, 2.1}, {3.2, 1.9, 3}, {"plaster", "partition"});
  return model;
}

TEST(Grid, EachRoomGetsOneOfItsOwnNamedAfterIt) {
  Site site(rooms_with_open_door(), {{1.5, 2, 2.5}});
  const auto grids = site.place_by_room(0.5, 0.0);
  ASSERT_EQ(grids.size(), 2U);
  EXPECT_EQ(grids[0].name, "room 1");
  EXPECT_EQ(grids[1].name, "room 2");
  for (const NamedSensors& grid : grids) {
    EXPECT_EQ(grid.sensors.count(), 6U * 8U);
    ASSERT_EQ(grid.sensors.outlines.size(), 1U);
    EXPECT_NEAR(area_of(grid.sensors.outlines[0]), 12.0, 1e-6);
  }
  EXPECT_TRUE(site.notices.empty());
}

TEST(Grid, RoomsWithOneNameGetGridsThatFilesCanTell) {
  Site site(rooms_with_open_door(), {{1.5, 2, 2.5}});
  site.rooms.rooms[0].name = "WC 1/2";
  site.rooms.rooms[1].name = "wc 1/2";
  auto grids = site.place_by_room(0.5);
  EXPECT_EQ(grids.at(0).name, "WC 1-2");
  EXPECT_EQ(grids.at(1).name, "wc 1-2 (2)");
  site.rooms.rooms[0].name = "Result";
  grids = site.place_by_room(0.5);
  EXPECT_EQ(grids.at(0).name, "room Result");
}

TEST(Grid, ARoomWithoutLightIsNamedAsLeftOut) {
  Site site(support::two_rooms_with_thin_wall({.thickness_m = 0.1}), {{1.5, 2, 2}});
  EXPECT_EQ(site.place_by_room(0.5).size(), 1U);
  ASSERT_EQ(site.notices.size(), 1U);
  EXPECT_THAT(site.notices[0], HasSubstr("room 2 has no grid"));
}

TEST(Grid, ARoomThatTheMarginEatsGetsOneSensorInItsMiddle) {
  // An L whose legs are narrower than twice the margin that its extent asks for.
  mesh::Model narrow;
  support::add_prism(narrow,
                     std::vector<Point>{{0, 0, 0}, {5, 0, 0}, {5, 0.9, 0}, {0.9, 0.9, 0}, {0.9, 5, 0}, {0, 5, 0}}, 0.0,
                     2.5, {"wall", "passage"}, support::Fronts::kInward);
  Site site(narrow, {{0.4, 0.4, 2}});
  const auto grids = site.place_by_room(0.25);
  ASSERT_EQ(grids.size(), 1U);
  ASSERT_EQ(grids[0].sensors.count(), 1U);
  EXPECT_EQ(grids[0].sensors.cells.size(), 1U);
  const Point p = grids[0].sensors.positions[0] + site.faces.origin;
  EXPECT_TRUE(p.x < 0.9 || p.y < 0.9);
  EXPECT_NEAR(p.z, 0.8, 1e-9);
}

TEST(Grid, WithoutARoofThereIsNoRoom) {
  EXPECT_THAT(Site(support::table_on_floor()).refusal(on("rooms")), HasSubstr("no room"));
}

}  // namespace
}  // namespace clerestory::lighting
