// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/all_sensors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

/// A closed room of 4 m x 4 m x 3 m with one sensor.
Study room() { return test::study_of(support::box_room(4, 4, 3), 0.5, {2, 2, 1}); }

struct Placed {
  explicit Placed(const Study& study) : scene(build_scene(study)) {
    NoProgress nobody;
    all = place_all_sensors(study, scene, results, nobody);
  }
  Scene scene;
  Results results;
  AllSensors all;
};

TEST(AllSensors, HaveThePointsOfEachGridAndTheirNumber) {
  Study study = room();
  study.grids.push_back(study.grids.front());
  study.grids.back().name = "again";
  const Placed placed(study);
  ASSERT_EQ(placed.results.grids.size(), 2U);
  ASSERT_EQ(placed.all.positions.size(), 2U);
  EXPECT_EQ(placed.all.grids, (std::vector<std::uint32_t>{0, 1}));
}

TEST(AllSensors, OfAGridWithModellingLookAlongACylinderToo) {
  Study study = room();
  study.grids.front().modelling = true;
  const Placed placed(study);
  ASSERT_EQ(placed.all.positions.size(), 2U);
  EXPECT_EQ(placed.all.normals[0].z, 1.0);
  EXPECT_EQ(placed.all.normals[1].z, 0.0);
  EXPECT_NEAR(norm(placed.all.normals[1]), 1.0, 1e-12);
  EXPECT_EQ(placed.results.grids[0].cylindrical_lux.size(), 1U);
}

TEST(AllSensors, HaveTheEyesOfObserversAfterTheGrids) {
  Study study = room();
  study.observers.push_back({"seat", {1, 1, 1.2}, {0, 1, 0}});
  const Placed placed(study);
  ASSERT_EQ(placed.all.positions.size(), 2U);
  EXPECT_EQ(placed.all.grids.back(), 1U);
  EXPECT_EQ(norm(placed.all.positions.back() - (mesh::Point{1, 1, 1.2} - placed.scene.faces.origin)), 0.0);
  EXPECT_EQ(placed.all.normals.back().y, 1.0);
}

}  // namespace
}  // namespace clerestory::lighting
