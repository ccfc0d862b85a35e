// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report_json.h"

#include <gtest/gtest.h>

namespace clerestory::io {
namespace {

using Kind = mesh::RoomOpening::Kind;

std::vector<mesh::Room> hall_and_store() {
  std::vector<mesh::Room> rooms(2);
  rooms[0] = {.name = "Hall",
              .floor_area_m2 = 48.00001,
              .volume_m3 = 144.0,
              .box = {},
              .stated = true,
              .not_apart = {},
              .openings = {{Kind::kGlazing, mesh::kNoRoom, 2.5, {1, 0, 1.5}}, {Kind::kHole, 1, 1.89, {6, 2, 1}}}};
  rooms[1] = {.name = "room 2",
              .floor_area_m2 = 12.0,
              .volume_m3 = 36.0,
              .box = {},
              .stated = false,
              .not_apart = {},
              .openings = {{Kind::kHole, 0, 1.89, {6, 2, 1}},
                           {Kind::kAir, mesh::kNoRoom, 4.0, {8, 2, 1}},
                           {Kind::kHole, mesh::kNoRoom, 0.2, {7, 0, 2}}}};
  return rooms;
}

TEST(RoomsJson, SaysWhatIsKnownOfEachRoom) {
  const auto json = rooms_json(hall_and_store());
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["name"], "Hall");
  EXPECT_EQ(json[0]["floor_area_m2"], 48.0) << "digits that mean nothing are left out";
  EXPECT_EQ(json[0]["volume_m3"], 144.0);
  EXPECT_EQ(json[0]["closed"], true);
  EXPECT_EQ(json[0]["source"], "file");
  EXPECT_EQ(json[1]["source"], "geometry");
}

TEST(RoomsJson, OpeningsNameWhereTheyLead) {
  const auto json = rooms_json(hall_and_store());
  const auto& openings = json[1]["openings"];
  ASSERT_EQ(openings.size(), 3U);
  EXPECT_EQ(openings[0]["kind"], "hole");
  EXPECT_EQ(openings[0]["to"], "Hall");
  EXPECT_EQ(openings[0]["area_m2"], 1.89);
  EXPECT_EQ(openings[1]["kind"], "air");
  EXPECT_EQ(openings[1]["to"], "outside");
  EXPECT_EQ(openings[2]["at"], Json({7.0, 0.0, 2.0}));
  EXPECT_EQ(json[0]["openings"][0]["kind"], "glazing");
}

TEST(DefectsJson, SayWhyDefectsWereLeft) {
  mesh::CleanReport report;
  report.defects = {{.kind = "gaps", .found = 3, .mended = 1, .places = {}},
                    {.kind = "needle polygons", .found = 2, .mended = 2, .places = {}}};
  for (const char* why : {"too wide", "too wide", ""})
    report.defects[0].places.push_back({.polygon = 0, .at = {}, .note = why, .size_m = 0.0, .mended = *why == 0});
  const auto json = defects_json(report);
  EXPECT_EQ(json["gaps"]["left"], Json::parse(R"([{"reason": "too wide", "count": 2}])"));
  EXPECT_FALSE(json["needle polygons"].contains("left"));
}

TEST(MeetingsJson, CountWhatIsNoDefect) {
  mesh::CleanReport report;
  report.contacts = 7;
  report.uncut_crossings = 2;
  report.two_sided = 1;
  EXPECT_EQ(meetings_json(report), Json::parse(R"({"contacts": 7, "uncut_crossings": 2, "two_sided_polygons": 1})"));
}

TEST(RoomsJson, AHoleToTheOutsideAndNothingElseMakesARoomOpen) {
  const auto json = rooms_json(hall_and_store());
  EXPECT_EQ(json[0]["closed"], true) << "an open door to another room";
  EXPECT_EQ(json[1]["closed"], false);
  EXPECT_EQ(rooms_json({}), Json::array());
}

}  // namespace
}  // namespace clerestory::io
