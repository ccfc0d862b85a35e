// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/received_flux.h"

#include <gtest/gtest.h>

#include "tests/lighting/stages.h"

namespace clerestory::lighting {
namespace {

/// A piece of the floor that has been refined.
mesh::ElementId refined_floor(const test::Solved& room) {
  for (const mesh::ElementId root : room.roots("floor")) {
    if (room.solution.is_open(root)) return root;
  }
  return {};
}

TEST(ReceivedFlux, OfARootIsThatOfItsElements) {
  const test::Solved room(test::furnished_room_study());
  const std::vector<double> flux = sunless_flux(room.solution, {});
  const mesh::ElementId floor = refined_floor(room);
  ASSERT_TRUE(floor.valid());
  const double expected_lm = room.solution.tree().area(floor) * room.mean_illuminance({floor});
  EXPECT_GT(expected_lm, 0.0);
  EXPECT_NEAR(flux[floor.index()] / expected_lm, 1.0, 1e-4);
}

TEST(ReceivedFlux, LosesWhatSunsGiveAboveAndBelow) {
  const test::Solved room(test::furnished_room_study());
  const mesh::ElementTree& tree = room.solution.tree();
  const mesh::ElementId floor = refined_floor(room);
  ASSERT_TRUE(floor.valid());
  const mesh::ElementId part = tree.first_child(floor);
  const std::vector<double> all = sunless_flux(room.solution, {});
  const std::vector<double> left = sunless_flux(room.solution, {{part, 5.0}});
  EXPECT_NEAR(all[part.index()] - left[part.index()], 5.0 * tree.area(part), 1e-3);
  EXPECT_NEAR(all[floor.index()] - left[floor.index()], 5.0 * tree.area(part), 1e-3);
}

TEST(ReceivedFlux, IsNoneWhereSunsGiveAll) {
  const test::Solved room(test::furnished_room_study());
  const mesh::ElementId floor = refined_floor(room);
  ASSERT_TRUE(floor.valid());
  const std::vector<double> left = sunless_flux(room.solution, {{floor, 1e9}});
  EXPECT_EQ(left[floor.index()], 0.0);
}

}  // namespace
}  // namespace clerestory::lighting
