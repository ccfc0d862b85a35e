// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/side_shells.h"

#include <gtest/gtest.h>

#include <set>

#include "mesh/clean.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

std::size_t shell_count(const Model& model) {
  CleanOptions options;
  options.gap_m = 0.0;
  const Faces faces = build_faces(clean(model, options));
  const std::vector<std::uint32_t> shells = side_shells(faces, number_regions(faces));
  return std::set(shells.begin(), shells.end()).size();
}

TEST(SideShells, AClosedRoomHasAnInsideAndAnOutside) { EXPECT_EQ(shell_count(support::box_room(4, 3, 3)), 2U); }

TEST(SideShells, AFreeSheetHasOne) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  EXPECT_EQ(shell_count(model), 1U);
}

TEST(SideShells, AThirdFaceAtEachEdgePartsTwoRoomsHoweverTurned) {
  for (const double rotation_rad : {0.0, 0.7, 2.1})
    EXPECT_EQ(
        shell_count(support::two_rooms_with_thin_wall({.rotation_rad = rotation_rad, .axis = {0.48, -0.6, 0.64}})), 3U);
}

TEST(SideShells, ASlitJoinsTwoRooms) {
  EXPECT_EQ(shell_count(support::two_rooms_with_thin_wall({.short_m = 0.05})), 2U);
}

TEST(SideShells, FacesThatShareOneEdgeBoundAsManySpacesAsThereAreAngles) {
  // Of five sheets round one edge all free edges join the front of each to its own back.
  EXPECT_EQ(shell_count(support::non_manifold_fan()), 1U);
}

}  // namespace
}  // namespace clerestory::mesh
