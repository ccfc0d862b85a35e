// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/room_bounds.h"

#include <gtest/gtest.h>

#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

RoomBounds bounds_of(mesh::Model model) {
  Study study = test::study_of(std::move(model), 0.5, {3, 4, 1});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({3, 4, 2.5}, 100.0));
  const test::Stage stage(study);
  const Scene& scene = stage.scene;
  const GridSite site({scene.faces, *scene.rays, scene.reachable_triangles, scene.rooms});
  return room_bounds(site, RegionGraph(site), 0, scene.passable);
}

TEST(RoomBounds, ABoxHasFourWallsAndACeilingThatLookInwards) {
  const RoomBounds bounds = bounds_of(support::box_room(6, 8, 3));
  ASSERT_EQ(bounds.walls.size(), 4U);
  ASSERT_EQ(bounds.ceilings.size(), 1U);
  EXPECT_NEAR(bounds.ceilings[0].frame.w.z, -1.0, 1e-12);
  mesh::Vector sum;
  for (const GridSurface& wall : bounds.walls) sum = sum + wall.frame.w;
  EXPECT_NEAR(norm(sum), 0.0, 1e-12);
}

TEST(RoomBounds, FurnitureIsNoWallAndItsUndersideNoCeiling) {
  mesh::Model model = support::box_room(6, 8, 3);
  support::add_box(model, {1, 1, 0}, {2, 3, 2}, {"cupboard", "wood"});
  support::add_table(model, {4, 5, 0});
  const RoomBounds bounds = bounds_of(std::move(model));
  EXPECT_EQ(bounds.walls.size(), 4U);
  EXPECT_EQ(bounds.ceilings.size(), 1U);
}

}  // namespace
}  // namespace clerestory::lighting
