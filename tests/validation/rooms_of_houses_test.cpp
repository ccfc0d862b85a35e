// SPDX-License-Identifier: GPL-3.0-or-later
// Rooms of the two houses whose files state theirs, found with and without these statements.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "io/model_file.h"
#include "io/study_file.h"
#include "lighting/scene.h"
#include "tests/support/places.h"

namespace clerestory {
namespace {

/// The rooms of a house as its file states them, and as its geometry tells them.
struct House {
  explicit House(const char* file) {
    const auto path = test::shared_data_dir() / "ifc" / file;
    lighting::Study study = io::read_study(path, {}).study;
    spaces = io::read_model(path).spaces;
    stated = lighting::build_scene(study).rooms;
    study.spaces.clear();
    found = lighting::build_scene(study).rooms;
  }

  /// The room found where a stated one is; kNoRoom where there is none.
  [[nodiscard]] std::uint32_t found_in(std::uint32_t space) const {
    std::map<std::uint32_t, std::size_t> votes;
    const mesh::Raster& raster = stated.map.raster();
    for (const mesh::RoomColumn& c : stated.map.columns()) {
      if (c.room != space || c.kind != mesh::RoomColumn::Kind::kWhole) continue;
      const double middle = 0.5 * (static_cast<double>(c.floor) + c.ceiling);
      const mesh::RoomColumn* at = found.map.at({raster.x(c.column), raster.y(c.column), middle});
      if (at != nullptr) ++votes[at->room];
    }
    const auto most = std::ranges::max_element(votes, {}, [](const auto& v) { return v.second; });
    return most == votes.end() ? mesh::kNoRoom : most->first;
  }

  /// How many spaces are found as rooms whose area is within 5 % of theirs.
  [[nodiscard]] std::size_t found_apart() const {
    std::size_t count = 0;
    for (std::uint32_t s = 0; s < spaces.size(); ++s) {
      const std::uint32_t room = found_in(s);
      if (room == mesh::kNoRoom) continue;
      const double area = stated.rooms[s].floor_area_m2;
      if (std::abs(found.rooms[room].floor_area_m2 - area) <= 0.05 * area) ++count;
    }
    return count;
  }

  /// The rooms that the geometry does not part, each with the reason.
  [[nodiscard]] std::vector<std::string> not_apart() const {
    std::vector<std::string> told;
    for (const mesh::Room& room : stated.rooms) {
      if (!room.not_apart.empty()) told.push_back(room.name + ": " + room.not_apart);
    }
    return told;
  }

  std::vector<io::ModelSpace> spaces;
  mesh::Rooms stated;
  mesh::Rooms found;
};

TEST(RoomsOfHouses, FzkHausHasItsSevenRoomsAndFiveOfThemByGeometryAlone) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc/AC20-FZK-Haus.ifc");
  const House house("AC20-FZK-Haus.ifc");
  ASSERT_EQ(house.spaces.size(), 7U);
  ASSERT_GE(house.stated.rooms.size(), 7U);
  for (std::size_t s = 0; s < 7; ++s) {
    EXPECT_EQ(house.stated.rooms[s].name, house.spaces[s].name);
    EXPECT_NEAR(house.stated.rooms[s].floor_area_m2, *house.spaces[s].floor_area_m2,
                0.001 * *house.spaces[s].floor_area_m2);
  }
  EXPECT_GE(house.found_apart(), 5U);
  EXPECT_EQ(house.not_apart(), (std::vector<std::string>{"5 Wohnen: no wall between it and '6 Küche'",
                                                         "6 Küche: no wall between it and '5 Wohnen'"}));
}

TEST(RoomsOfHouses, DuplexHasItsTwentyOneRoomsAndEighteenOfThemByGeometryAlone) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc/duplex.ifc");
  const House house("duplex.ifc");
  ASSERT_EQ(house.spaces.size(), 21U);
  ASSERT_GE(house.stated.rooms.size(), 21U);
  std::size_t volumes = 0;
  for (std::size_t s = 0; s < 21; ++s) {
    const double stated = *house.spaces[s].volume_m3;
    if (std::abs(house.stated.rooms[s].volume_m3 - stated) <= 0.001 * stated) ++volumes;
  }
  EXPECT_GE(volumes, 19U) << "but for two stair halls, which are open shells";
  EXPECT_GE(house.found_apart(), 18U);
  // Those that are not: two flights of stairs, which lead from room to room, and the space above the roof.
  EXPECT_EQ(house.not_apart(),
            (std::vector<std::string>{"A105 Stair: no walls enclose it", "B105 Room: no walls enclose it",
                                      "R301 Roof: no walls enclose it"}));
}

}  // namespace
}  // namespace clerestory
