// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mesh/clean.h"
#include "mesh/reachable.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

using support::add_box;
using support::add_polygon;
using support::add_quad;
using Kind = RoomOpening::Kind;

/// A model with its rooms. Panes are faces of the material "glass", air polygons those of "air".
struct Building {
  explicit Building(const Model& model, const std::vector<Space>& spaces = {})
      : faces(build_faces(clean(model, {}))), glass(of_material("glass")), air(of_material("air")), rays(faces, glass) {
    const auto reached = reachable_triangles(faces, rays, reachable_sides(faces, rays, {}, {}));
    found = find_rooms(faces, rays, {.glazing = glass, .air = air, .reached = reached, .spaces = spaces});
  }
  [[nodiscard]] std::vector<std::uint8_t> of_material(const std::string& name) const {
    std::vector<std::uint8_t> which;
    for (const Face& face : faces.faces) which.push_back(faces.material_names[face.material.index()] == name ? 1 : 0);
    return which;
  }
  [[nodiscard]] std::uint32_t at(const Point& p) const { return room_at(found, rays, p - faces.origin); }
  [[nodiscard]] const std::vector<Room>& rooms() const { return found.rooms; }
  [[nodiscard]] std::size_t count(std::size_t room, Kind kind) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(rooms()[room].openings, [&](const RoomOpening& o) { return o.kind == kind; }));
  }

  Faces faces;
  std::vector<std::uint8_t> glass;
  std::vector<std::uint8_t> air;
  Rays rays;
  Rooms found;
};

/// A wall of 0.2 m across a room of 6 m × 4 m × 3 m at x = 3, with an opening from y = 1 on, as a solid without foot and head.
Model divided_room(double width_m, double height_m) {
  Model model = support::box_room(6, 4, 3);
  const support::Names wall{"wall", "partition"};
  add_box(model, {2.9, 0, 0}, {3.1, 1, 3}, wall);
  add_box(model, {2.9, 1 + width_m, 0}, {3.1, 4, 3}, wall);
  if (height_m < 3.0) add_box(model, {2.9, 1, height_m}, {3.1, 1 + width_m, 3}, wall);
  return model;
}

/// A room of 4 m × 4 m × 3 m whose wall at y = 0 has a hole of 0.5 m × 0.4 m about (2, 0, 1.2).
Model leaking_room() {
  Model model;
  add_box(model, {0, 0, 0}, {4, 4, 3}, {"wall", "room"}, support::Fronts::kInward);
  Model open;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    std::vector<Point> outer;
    for (const std::uint32_t c : model.loop(p)) outer.push_back(model.vertices[c]);
    const bool front = std::ranges::all_of(outer, [](const Point& q) { return q.y == 0.0; });
    std::vector<std::vector<Point>> holes;
    if (front) holes.push_back({{1.75, 0, 1.0}, {1.75, 0, 1.4}, {2.25, 0, 1.4}, {2.25, 0, 1.0}});
    add_polygon(open, outer, {"wall", "room"}, holes);
  }
  return open;
}

/// A house of 10 m × 6 m with walls of 0.5 m to 2.5 m height and a gable roof whose ridge, over y = 3, is 5 m high.
Model gabled_attic() {
  Model model;
  add_quad(model, {0, 0, 0}, {10, 0, 0}, {10, 6, 0}, {0, 6, 0}, {"floor", "attic"});
  add_quad(model, {0, 0, 0.5}, {0, 3, 5}, {10, 3, 5}, {10, 0, 0.5}, {"roof", "attic"});
  add_quad(model, {0, 6, 0.5}, {10, 6, 0.5}, {10, 3, 5}, {0, 3, 5}, {"roof", "attic"});
  add_quad(model, {0, 0, 0}, {0, 0, 0.5}, {10, 0, 0.5}, {10, 0, 0}, {"wall", "attic"});
  add_quad(model, {0, 6, 0}, {10, 6, 0}, {10, 6, 0.5}, {0, 6, 0.5}, {"wall", "attic"});
  for (const double x : {0.0, 10.0}) {
    add_polygon(model, {{x, 0, 0}, {x, 6, 0}, {x, 6, 0.5}, {x, 3, 5}, {x, 0, 0.5}}, {"wall", "attic"});
  }
  return model;
}

TEST(Rooms, ClosedBoxIsOneRoomOfItsAreaAndVolume) {
  const Building b(support::moved(support::box_room(6, 8, 3), {500, -300, 40}));
  ASSERT_EQ(b.rooms().size(), 1U);
  EXPECT_EQ(b.rooms()[0].name, "room 1");
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 48.0, 1e-9);
  EXPECT_NEAR(b.rooms()[0].volume_m3, 144.0, 1e-3);
  EXPECT_TRUE(b.rooms()[0].closed());
  EXPECT_TRUE(b.rooms()[0].openings.empty());
  EXPECT_EQ(b.at({503, -296, 41}), 0U);
  EXPECT_EQ(b.at({500.01, -299.99, 40.01}), 0U);
  EXPECT_EQ(b.at({499.9, -296, 41}), kNoRoom);
}

TEST(Rooms, TurnedLRoomKeepsItsAreaAndVolume) {
  for (const double angle : {0.0, 0.3, 0.7}) {
    const Building b(support::rotated(support::l_room(), {0, 0, 1}, angle));
    ASSERT_EQ(b.rooms().size(), 1U) << angle;
    EXPECT_NEAR(b.rooms()[0].floor_area_m2, 12.0, 0.01) << angle;
    EXPECT_NEAR(b.rooms()[0].volume_m3, 36.0, 0.05) << angle;
    EXPECT_TRUE(b.rooms()[0].closed());
  }
}

TEST(Rooms, WallsWithAndWithoutThicknessDivide) {
  for (const double thickness : {0.0, 0.1}) {
    const Building b(support::two_rooms_with_thin_wall({.thickness_m = thickness}));
    ASSERT_EQ(b.rooms().size(), 2U);
    for (const Room& room : b.rooms()) {
      EXPECT_NEAR(room.floor_area_m2, 12.0 - 2.0 * thickness, 0.01);
      EXPECT_TRUE(room.closed());
      EXPECT_TRUE(room.openings.empty());
    }
    EXPECT_EQ(b.at({1, 1, 1}), 0U);
    EXPECT_EQ(b.at({5, 1, 1}), 1U);
  }
}

TEST(Rooms, OpenDoorsAndNarrowPassagesDivideWideOpeningsJoin) {
  for (const double height : {2.1, 3.0}) {
    const Building b(divided_room(0.9, height));
    ASSERT_EQ(b.rooms().size(), 2U) << height;
    for (std::size_t r = 0; r < 2; ++r) {
      const Room& room = b.rooms()[r];
      EXPECT_NEAR(room.floor_area_m2, 11.6, 0.3) << height;
      EXPECT_TRUE(room.closed());
      ASSERT_EQ(room.openings.size(), 1U) << height;
      EXPECT_EQ(room.openings[0].kind, Kind::kHole);
      EXPECT_EQ(room.openings[0].beyond, 1 - r);
      EXPECT_NEAR(room.openings[0].area_m2, 0.9 * height, 0.25 * height);
      EXPECT_NEAR((room.openings[0].at + b.faces.origin).y, 1.45, 0.15);
    }
  }
  const Building wide(divided_room(2.5, 3.0));
  ASSERT_EQ(wide.rooms().size(), 1U);
  EXPECT_NEAR(wide.rooms()[0].floor_area_m2, 23.7, 0.1);
  EXPECT_EQ(Building(divided_room(2.5, 2.1)).rooms().size(), 2U) << "with a lintel it is a doorway still";
}

/// A room of 8 m × 6 m × 3 m with a wall of 0.12 m along x = 2 that lacks 2.8 m from y = `from` on.
Model hall_along_a_room(double from) {
  Model model = support::box_room(8, 6, 3);
  const support::Names wall{"wall", "partition"};
  add_box(model, {2, 0, 0}, {2.12, from, 3}, wall);
  add_box(model, {2, from + 2.8, 0}, {2.12, 6, 3}, wall);
  return model;
}

TEST(Rooms, WallOfWhichMostStandsDividesAHallFromARoomWiderThanTheHall) {
  for (const double angle : {0.0, 0.5}) {
    const Building b(support::rotated(hall_along_a_room(1.5), {0, 0, 1}, angle));
    ASSERT_EQ(b.rooms().size(), 2U) << angle;
    const auto [hall, room] = std::minmax(b.rooms()[0].floor_area_m2, b.rooms()[1].floor_area_m2);
    EXPECT_NEAR(hall, 12.0, 0.4) << angle;
    EXPECT_NEAR(room, 35.28, 0.4) << angle;
  }
  EXPECT_EQ(Building(hall_along_a_room(0.1)).rooms().size(), 1U) << "no end of a wall on that side";
}

TEST(Rooms, WallOfWhichMostIsMissingDoesNotDivide) {
  Model model = support::box_room(8, 6, 3);
  add_box(model, {2, 0, 0}, {2.12, 1.4, 3}, {"wall", "partition"});
  add_box(model, {2, 4.6, 0}, {2.12, 6, 3}, {"wall", "partition"});
  EXPECT_EQ(Building(model).rooms().size(), 1U);
}

TEST(Rooms, ColumnsOfAHallDoNotDivide) {
  Model model = support::box_room(12, 9, 3);
  for (const double x : {2.8, 5.8, 8.8}) {
    for (const double y : {2.8, 5.8}) add_box(model, {x, y, 0}, {x + 0.4, y + 0.4, 3}, {"concrete", "column"});
  }
  EXPECT_EQ(Building(model).rooms().size(), 1U);
}

/// A room of 6 m × 6 m × 3 m with tiles from y = 4 on, and along their edge a counter of this height and length.
Model kitchen(double counter_height_m, double counter_length_m) {
  Model model = support::box_room(6, 6, 3);
  add_box(model, {0, 4, 0}, {6, 6, 0.01}, {"tiles", "kitchen floor"});
  if (counter_length_m > 0.0)
    add_box(model, {0, 4.01, 0.01}, {counter_length_m, 4.6, counter_height_m}, {"wood", "counter"});
  return model;
}

TEST(Rooms, CounterAlongTheEdgeOfAFloorFinishDivides) {
  const Building b(kitchen(1.0, 4.0));
  ASSERT_EQ(b.rooms().size(), 2U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 24.0, 0.3);
  EXPECT_NEAR(b.rooms()[1].floor_area_m2, 12.0, 0.3);
  EXPECT_EQ(Building(kitchen(0.0, 0.0)).rooms().size(), 1U) << "tiles alone do not";
  EXPECT_EQ(Building(kitchen(0.72, 4.0)).rooms().size(), 1U) << "nor does a table";
  EXPECT_EQ(Building(kitchen(1.0, 2.5)).rooms().size(), 1U) << "nor what stands along the smaller part";
}

TEST(Rooms, ShaftOfASkylightBelongsToItsRoom) {
  Model model = support::box_room(6, 4, 3);
  Model room;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    std::vector<Point> outer;
    for (const std::uint32_t c : model.loop(p)) outer.push_back(model.vertices[c]);
    if (!std::ranges::all_of(outer, [](const Point& q) { return q.z == 3.0; })) add_polygon(room, outer);
  }
  const std::vector<Point> hole{{2, 1, 3}, {3, 1, 3}, {3, 2, 3}, {2, 2, 3}};
  add_polygon(room, {{0, 0, 3}, {0, 4, 3}, {6, 4, 3}, {6, 0, 3}}, {"ceiling", "room"}, {hole});
  support::add_prism(room, hole, 3.0, 3.8, {"wall", "shaft"}, support::Fronts::kInward);
  const Building b(room);
  ASSERT_EQ(b.rooms().size(), 1U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 24.0, 0.05);
}

TEST(Rooms, BeamsDoNotDivide) {
  for (const double below : {2.8, 2.4, 2.1}) {
    Model model = support::box_room(6, 4, 3);
    add_box(model, {2.9, 0, below}, {3.1, 4, 3}, {"concrete", "beam"});
    const Building b(model);
    ASSERT_EQ(b.rooms().size(), 1U) << below;
    EXPECT_NEAR(b.rooms()[0].floor_area_m2, 24.0, 0.05);
    EXPECT_NEAR(b.rooms()[0].volume_m3, 72.0 - 0.8 * (3.0 - below), 0.3);
  }
}

TEST(Rooms, FloorsEndAtTheInnerFaceOfTheWallBelowAWindowAsHighAsTheRoom) {
  Model model;
  add_box(model, {0, 0, 0}, {5, 4, 2.6}, {"wall", "room"}, support::Fronts::kInward);
  Model room;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    std::vector<Point> outer;
    for (const std::uint32_t c : model.loop(p)) outer.push_back(model.vertices[c]);
    if (!std::ranges::all_of(outer, [](const Point& q) { return q.y == 0.0; })) add_polygon(room, outer);
  }
  add_quad(room, {0, 0, 0}, {1, 0, 0}, {1, 0, 2.6}, {0, 0, 2.6});
  add_quad(room, {4, 0, 0}, {5, 0, 0}, {5, 0, 2.6}, {4, 0, 2.6});
  for (const double x : {1.0, 4.0}) add_quad(room, {x, 0, 0}, {x, -0.4, 0}, {x, -0.4, 2.6}, {x, 0, 2.6});
  for (const double z : {0.0, 2.6}) add_quad(room, {1, 0, z}, {4, 0, z}, {4, -0.4, z}, {1, -0.4, z});
  add_quad(room, {1, -0.3, 0}, {4, -0.3, 0}, {4, -0.3, 2.6}, {1, -0.3, 2.6}, {"glass", "window"});
  const Building b(room);
  ASSERT_EQ(b.rooms().size(), 1U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 20.0, 0.1);
  EXPECT_NEAR(b.rooms()[0].volume_m3, 52.0, 0.3);
  EXPECT_TRUE(b.rooms()[0].closed());
  EXPECT_EQ(b.at({2.5, -0.2, 1}), 0U) << "the reveal is still of the room";
}

TEST(Rooms, RoomInARoomIsOneOfItsOwn) {
  Model model = support::box_room(10, 10, 3);
  add_box(model, {3, 3, 0}, {6, 6, 3}, {"wall", "core"});
  add_box(model, {3.1, 3.1, 0}, {5.9, 5.9, 3}, {"wall", "core"}, support::Fronts::kInward);
  const Building b(model);
  ASSERT_EQ(b.rooms().size(), 2U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 91.0, 0.3);
  EXPECT_NEAR(b.rooms()[1].floor_area_m2, 7.84, 0.02);
  EXPECT_EQ(b.at({4.5, 4.5, 1}), 1U);
}

TEST(Rooms, FurnitureDoesNotDivideNorCount) {
  Model model = support::box_room(6, 4, 3);
  support::add_table(model, {1, 1, 0});
  add_box(model, {2.9, 0, 0}, {3.4, 4, 2.2}, {"wood", "bookshelves"});
  add_box(model, {4, 1, 0}, {6, 3, 0.5}, {"fabric", "bed"});
  add_box(model, {4.5, 0.2, 2.3}, {5.5, 0.6, 2.4}, {"metal", "lamp"});
  const Building b(model);
  ASSERT_EQ(b.rooms().size(), 1U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 24.0, 0.05);
  EXPECT_NEAR(b.rooms()[0].volume_m3, 72.0, 0.3);
  EXPECT_EQ(b.at({1.5, 1.4, 0.3}), 0U) << "below the table";
}

TEST(Rooms, SolidsAreNotRooms) {
  Model model;
  add_box(model, {-5, -5, -3}, {15, 15, 0}, {"earth", "ground"});
  add_box(model, {0, 0, 0}, {10, 10, 3.3}, {"concrete", "outside"});
  add_box(model, {0.8, 0.8, 0}, {9.2, 9.2, 3}, {"plaster", "inside"}, support::Fronts::kInward);
  const Building b(model);
  ASSERT_EQ(b.rooms().size(), 1U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 8.4 * 8.4, 0.05);
  EXPECT_EQ(b.at({5, 5, -1}), kNoRoom);
}

TEST(Rooms, SolidsAreToldWhereFrontsLookOutwardsToo) {
  Model model;
  add_box(model, {20, 0, 0}, {30, 10, 8}, {"concrete", "neighbour"});
  // A room of outward fronts, lit by a window that fills its wall at y = 0.
  add_quad(model, {0, 0, 0}, {0, 4, 0}, {4, 4, 0}, {4, 0, 0});
  add_quad(model, {0, 0, 3}, {4, 0, 3}, {4, 4, 3}, {0, 4, 3});
  add_quad(model, {0, 0, 0}, {0, 0, 3}, {0, 4, 3}, {0, 4, 0});
  add_quad(model, {4, 0, 0}, {4, 4, 0}, {4, 4, 3}, {4, 0, 3});
  add_quad(model, {0, 4, 0}, {0, 4, 3}, {4, 4, 3}, {4, 4, 0});
  add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}, {"glass", "window"});
  const Building b(model);
  ASSERT_EQ(b.rooms().size(), 1U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 16.0, 1e-6);
}

TEST(Rooms, AtticReachesDownToItsEaves) {
  const Building b(gabled_attic());
  ASSERT_EQ(b.rooms().size(), 1U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 60.0, 0.3);
  EXPECT_NEAR(b.rooms()[0].volume_m3, 60.0 * 2.75, 1.0);
  EXPECT_TRUE(b.rooms()[0].closed());
}

TEST(Rooms, GalleryBelongsToItsHallAndCountsAsFloor) {
  Model model = support::box_room(6, 6, 6);
  add_box(model, {0, 0, 3}, {6, 2, 3.2}, {"concrete", "gallery"});
  const Building b(model);
  ASSERT_EQ(b.rooms().size(), 1U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 48.0, 0.2);
  EXPECT_NEAR(b.rooms()[0].volume_m3, 216.0 - 2.4, 1.0);
}

TEST(Rooms, StairwellConnectsTwoRooms) {
  Model model;
  const std::vector<Point> hole{{1, 1, 0}, {1, 4, 0}, {2.2, 4, 0}, {2.2, 1, 0}};
  const auto level = [&](double z, bool open) {
    std::vector<std::vector<Point>> holes;
    if (open) holes.push_back(hole);
    for (auto& loop : holes) {
      for (Point& p : loop) p.z = z;
    }
    add_polygon(model, {{0, 0, z}, {8, 0, z}, {8, 6, z}, {0, 6, z}}, {"concrete", "slab"}, holes);
  };
  level(0, false);
  level(3, true);
  level(6, false);
  add_quad(model, {0, 0, 0}, {0, 0, 6}, {8, 0, 6}, {8, 0, 0});
  add_quad(model, {0, 6, 0}, {8, 6, 0}, {8, 6, 6}, {0, 6, 6});
  add_quad(model, {0, 0, 0}, {0, 6, 0}, {0, 6, 6}, {0, 0, 6});
  add_quad(model, {8, 0, 0}, {8, 0, 6}, {8, 6, 6}, {8, 6, 0});
  const Building b(model);
  ASSERT_EQ(b.rooms().size(), 2U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 48.0, 0.3);
  EXPECT_NEAR(b.rooms()[0].volume_m3, 144.0, 1.5);
  EXPECT_NEAR(b.rooms()[1].floor_area_m2, 44.4, 0.5);
  ASSERT_EQ(b.rooms()[0].openings.size(), 1U);
  EXPECT_EQ(b.rooms()[0].openings[0].beyond, 1U);
  EXPECT_NEAR(b.rooms()[0].openings[0].area_m2, 3.6, 0.5);
  EXPECT_TRUE(b.rooms()[0].closed());
  EXPECT_TRUE(b.rooms()[1].closed());
}

TEST(Rooms, RoomWithoutCeilingIsNotClosed) {
  Model model;
  add_quad(model, {0, 0, 0}, {5, 0, 0}, {5, 4, 0}, {0, 4, 0}, {"floor", "room"});
  add_quad(model, {0, 0, 0}, {0, 0, 3}, {5, 0, 3}, {5, 0, 0});
  add_quad(model, {0, 4, 0}, {5, 4, 0}, {5, 4, 3}, {0, 4, 3});
  add_quad(model, {0, 0, 0}, {0, 4, 0}, {0, 4, 3}, {0, 0, 3});
  add_quad(model, {5, 0, 0}, {5, 0, 3}, {5, 4, 3}, {5, 4, 0});
  const Building b(model);
  ASSERT_EQ(b.rooms().size(), 1U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 20.0, 0.05);
  EXPECT_NEAR(b.rooms()[0].volume_m3, 60.0, 0.5);
  EXPECT_FALSE(b.rooms()[0].closed());
  ASSERT_EQ(b.rooms()[0].openings.size(), 1U);
  EXPECT_NEAR((b.rooms()[0].openings[0].at + b.faces.origin).z, 3.0, 0.01);
}

TEST(Rooms, LeakIsTold) {
  const Building b(leaking_room());
  ASSERT_EQ(b.rooms().size(), 1U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 16.0, 1e-6);
  EXPECT_FALSE(b.rooms()[0].closed());
  ASSERT_EQ(b.rooms()[0].openings.size(), 1U);
  const RoomOpening& hole = b.rooms()[0].openings[0];
  EXPECT_EQ(hole.kind, Kind::kHole);
  EXPECT_EQ(hole.beyond, kNoRoom);
  EXPECT_NEAR(hole.area_m2, 0.2, 0.05);
  const Point at = hole.at + b.faces.origin;
  EXPECT_NEAR(at.x, 2.0, 0.06);
  EXPECT_NEAR(at.y, 0.0, 0.06);
  EXPECT_NEAR(at.z, 1.2, 0.01);
}

TEST(Rooms, SmallGapsAreBridged) {
  Model model;
  for (const double x : {0.0, 3.03}) {  // two halves of a box that do not meet
    add_quad(model, {x, 0, 0}, {x + 3, 0, 0}, {x + 3, 4, 0}, {x, 4, 0}, {"floor", "room"});
    add_quad(model, {x, 0, 3}, {x, 4, 3}, {x + 3, 4, 3}, {x + 3, 0, 3});
    add_quad(model, {x, 0, 0}, {x, 0, 2.95}, {x + 3, 0, 2.95}, {x + 3, 0, 0});
    add_quad(model, {x, 4, 0}, {x + 3, 4, 0}, {x + 3, 4, 3}, {x, 4, 3});
  }
  add_quad(model, {0, 0, 0}, {0, 4, 0}, {0, 4, 3}, {0, 0, 3});
  add_quad(model, {6.03, 0, 0}, {6.03, 0, 3}, {6.03, 4, 3}, {6.03, 4, 0});
  const Building b(model);
  ASSERT_EQ(b.rooms().size(), 1U);
  EXPECT_TRUE(b.rooms()[0].closed());
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 24.1, 0.15);
}

TEST(Rooms, PanesAndAirPolygonsAreOpeningsAndEndRooms) {
  for (const auto& [material, kind] : {std::pair{"glass", Kind::kGlazing}, {"air", Kind::kAir}}) {
    Model model = leaking_room();
    add_quad(model, {1.75, 0, 1.0}, {2.25, 0, 1.0}, {2.25, 0, 1.4}, {1.75, 0, 1.4}, {material, "window"});
    add_quad(model, {2.5, 0, 0}, {2.5, 4, 0}, {2.5, 4, 3}, {2.5, 0, 3}, {material, "screen"});
    const Building b(model);
    ASSERT_EQ(b.rooms().size(), 2U);
    EXPECT_NEAR(b.rooms()[0].floor_area_m2, 10.0, 1e-6);
    EXPECT_TRUE(b.rooms()[0].closed());
    ASSERT_EQ(b.count(0, kind), 2U);
    ASSERT_EQ(b.count(1, kind), 1U);
    EXPECT_NEAR(b.rooms()[1].openings[0].area_m2, 12.0, 1e-6);
    EXPECT_EQ(b.rooms()[1].openings[0].beyond, 0U);
    const auto window = std::ranges::find(b.rooms()[0].openings, kNoRoom, &RoomOpening::beyond);
    ASSERT_NE(window, b.rooms()[0].openings.end());
    EXPECT_NEAR(window->area_m2, 0.2, 1e-6);
  }
}

TEST(Rooms, PaneInADeepNicheIsAnOpeningOfItsRoom) {
  Model model = support::glass_box_in_wall(0.024);
  Model closed = support::box_room(4, 5, 3);
  Model room;
  for (std::size_t p = 0; p < closed.polygon_count(); ++p) {
    std::vector<Point> outer;
    for (const std::uint32_t c : closed.loop(p)) outer.push_back(closed.vertices[c]);
    if (!std::ranges::all_of(outer, [](const Point& q) { return q.y == 5.0; })) add_polygon(room, outer);
  }
  support::append(room, support::moved(model, {0, 5, 0}));
  const Building b(room);
  ASSERT_EQ(b.rooms().size(), 1U);
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 20.0, 0.05);
  EXPECT_TRUE(b.rooms()[0].closed());
  EXPECT_GE(b.count(0, Kind::kGlazing), 1U);
  EXPECT_EQ(b.at({2, 5.08, 1.5}), 0U) << "the niche";
}

TEST(Rooms, FloorTrianglesTellTheirRoom) {
  const Building b(support::two_rooms_with_thin_wall());
  std::array<double, 2> area{};
  for (std::uint32_t t = 0; t < b.found.floor_of.size(); ++t) {
    if (b.found.floor_of[t] == kNoRoom) continue;
    const auto& v = b.faces.shape.vertices;
    const auto& [i, j, k] = b.faces.shape.triangles[t].vertices;
    area[b.found.floor_of[t]] += 0.5 * norm(cross(v[j] - v[i], v[k] - v[i]));
  }
  EXPECT_NEAR(area[0], 12.0, 1e-9);
  EXPECT_NEAR(area[1], 12.0, 1e-9);
}

TEST(Rooms, LowerLayersOfAFloorAreNone) {
  Model model = support::box_room(6, 4, 3);
  add_box(model, {0, 0, 0.013}, {6, 2, 0.033}, {"screed", "screed"});
  const Building b(model);
  double slab = 0.0;
  double screed = 0.0;
  for (std::uint32_t t = 0; t < b.found.floor_of.size(); ++t) {
    if (b.found.floor_of[t] == kNoRoom) continue;
    const auto& v = b.faces.shape.vertices;
    const auto& [i, j, k] = b.faces.shape.triangles[t].vertices;
    const double z = v[i].z + b.faces.origin.z;
    (z < 0.02 ? slab : screed) += 0.5 * norm(cross(v[j] - v[i], v[k] - v[i]));
  }
  EXPECT_NEAR(screed, 12.0, 1e-6) << "its upper side, and not its lower one";
  EXPECT_LE(slab, 12.0 + 1e-6);
}

TEST(Rooms, SurfacesKnowTheRoomThatTheyLookInto) {
  const Building b(support::two_rooms_with_thin_wall({.thickness_m = 0.1}));
  const auto before = [&](const Point& p, const Vector& n) {
    return room_before(b.found, b.rays, p - b.faces.origin, n);
  };
  EXPECT_EQ(before({2.95, 2, 1.5}, {-1, 0, 0}), 0U);
  EXPECT_EQ(before({2.95, 2, 1.5}, {1, 0, 0}), kNoRoom);
  EXPECT_EQ(before({3.05, 2, 1.5}, {1, 0, 0}), 1U);
  EXPECT_EQ(before({0.5, 0.5, 0}, {0, 0, 1}), 0U);
  EXPECT_EQ(before({0.5, 0.5, 0}, {0, 0, -1}), kNoRoom);
}

TEST(Rooms, SpacesOfTheFileAreTheRooms) {
  Model building = support::box_room(6, 4, 3);
  add_box(building, {2.9, 0, 0}, {3.1, 1.5, 3}, {"wall", "stub"});
  Model left;
  add_box(left, {0, 0, 0}, {3, 4, 2.5});
  Model right;
  support::add_prism(right, std::vector<Point>{{3, 0, 0}, {6, 0, 0}, {6, 4, 0}, {3, 4, 0}}, 0.0, 3.0);
  const Building b(building, {{"Bath", left}, {"", right}});
  ASSERT_EQ(b.rooms().size(), 2U);
  EXPECT_EQ(b.rooms()[0].name, "Bath");
  EXPECT_EQ(b.rooms()[1].name, "room 2");
  EXPECT_TRUE(b.rooms()[0].stated);
  EXPECT_EQ(b.rooms()[0].not_apart, "no wall between it and ''");
  EXPECT_NEAR(b.rooms()[0].floor_area_m2, 12.0, 1e-9);
  EXPECT_NEAR(b.rooms()[0].volume_m3, 30.0, 1e-9);
  EXPECT_NEAR(b.rooms()[1].volume_m3, 36.0, 1e-9);
  EXPECT_EQ(b.at({1, 2, 1}), 0U);
  EXPECT_EQ(b.at({5, 2, 1}), 1U);
}

TEST(Rooms, RoomsWithoutASpaceAreFoundBesideTheStated) {
  Model left;
  add_box(left, {0, 0, 0}, {3, 4, 3});
  const Building b(support::two_rooms_with_thin_wall(), {{"Bath", left}});
  ASSERT_EQ(b.rooms().size(), 2U);
  EXPECT_EQ(b.rooms()[0].name, "Bath");
  EXPECT_FALSE(b.rooms()[1].stated);
  EXPECT_NEAR(b.rooms()[1].floor_area_m2, 12.0, 1e-9);
}

TEST(Rooms, ModelsWithoutAnythingOverheadHaveNone) {
  EXPECT_TRUE(Building(support::table_on_floor()).rooms().empty());
  EXPECT_TRUE(Building(support::facing_squares(0.5)).rooms().empty());
}

TEST(Rooms, AreNumberedByStoreyAndPlace) {
  Model model;
  for (const Vector& at : {Vector{0, 0, 3.5}, Vector{5, 0, 0}, Vector{0, 5, 0.2}, Vector{0, 0, 0}}) {
    support::append(model, support::moved(support::box_room(4, 4, 3), at));
  }
  const Building b(model);
  ASSERT_EQ(b.rooms().size(), 4U);
  EXPECT_EQ(b.at({2, 2, 1}), 0U);
  EXPECT_EQ(b.at({7, 2, 1}), 1U);
  EXPECT_EQ(b.at({2, 7, 1}), 2U);
  EXPECT_EQ(b.at({2, 2, 4.5}), 3U);
}

}  // namespace
}  // namespace clerestory::mesh
