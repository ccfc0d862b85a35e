// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/task_areas.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/error.h"
#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;

/// A lit room of 6 m × 8 m × 3 m with one task.
Study task_room() {
  Study study = test::study_of(support::box_room(6, 8, 3), 0.5, {3, 4, 1});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({3, 4, 2.5}, 100.0));
  TaskRequest task;
  task.name = "writing";
  task.required = {.task = "", .illuminance_lux = 500, .uniformity = 0.6, .ugr = 19, .walls_lux = 100};
  study.tasks.push_back(task);
  return study;
}

const Sensors& sensors(const PlacedTask& task, TaskArea area) { return task.area(area).value().sensors; }

TEST(TaskAreas, OfAWholeRoomAreItsFloorWallsAndCeilingByTheStandardsSpacing) {
  const test::Stage stage(task_room());
  const auto tasks = place_tasks(task_room(), stage.scene, {});
  ASSERT_EQ(tasks.size(), 1U);
  const PlacedTask& task = tasks[0];
  EXPECT_EQ(task.name, "writing");
  EXPECT_FALSE(task.area(TaskArea::kSurrounding).has_value());
  // 5 m by 7 m remain; p = 0.2·5^log10(8) = 0.86 m.
  EXPECT_EQ(sensors(task, TaskArea::kTask).count(), 6U * 8U);
  EXPECT_EQ(sensors(task, TaskArea::kCeiling).count(), 6U * 8U);
  for (const mesh::Vector& n : sensors(task, TaskArea::kCeiling).normals) EXPECT_NEAR(n.z, -1.0, 1e-12);
  double sideways = 0.0;
  for (const mesh::Vector& n : sensors(task, TaskArea::kWalls).normals) {
    EXPECT_NEAR(n.z, 0.0, 1e-12);
    sideways += std::abs(n.x);
  }
  EXPECT_GT(sideways, 0.0);
  EXPECT_LT(sideways, static_cast<double>(sensors(task, TaskArea::kWalls).count()));
  const double floor_z = sensors(task, TaskArea::kTask).positions[0].z - 0.75;
  EXPECT_NEAR(sensors(task, TaskArea::kActivity).positions[0].z, floor_z + 1.2, 1e-9);
}

TEST(TaskAreas, FourObserversLookAcrossARoomWithoutOne) {
  Study study = task_room();
  const test::Stage stage(study);
  const auto own = place_tasks(study, stage.scene, {})[0].observers;
  ASSERT_EQ(own.size(), 4U);
  for (const Observer& o : own) {
    EXPECT_NEAR(o.eye.z, 1.2, 1e-9);
    // Towards the middle of the room.
    EXPECT_GT(dot(Point{3, 4, 1.2} - o.eye, o.look), 2.9);
  }
  study.observers.push_back({"desk", {1, 1, 1.2}, {0, 1, 0}});
  EXPECT_TRUE(place_tasks(study, stage.scene, {})[0].observers.empty());
}

TEST(TaskAreas, ARectangleHasASurroundingOfHalfAMetreAndABackground) {
  Study study = task_room();
  mesh::Box rectangle;
  rectangle.add(Point{2, 3, 0});
  rectangle.add(Point{3.6, 3.8, 0});
  study.tasks[0].rectangle = rectangle;
  const test::Stage stage(study);
  const PlacedTask task = place_tasks(study, stage.scene, {})[0];
  const mesh::Vector& origin = stage.scene.faces.origin;
  for (const Point& local : sensors(task, TaskArea::kTask).positions) {
    const Point p = local + origin;
    EXPECT_TRUE(p.x > 2 && p.x < 3.6 && p.y > 3 && p.y < 3.8);
  }
  // The shorter side counts where the longer is twice as long: p = 0.2·5^log10(0.8) = 0.171 m, 10 by 5 cells.
  EXPECT_EQ(sensors(task, TaskArea::kTask).count(), 50U);
  for (const Point& local : sensors(task, TaskArea::kSurrounding).positions) {
    const Point p = local + origin;
    EXPECT_TRUE(p.x > 1.5 && p.x < 4.1 && p.y > 2.5 && p.y < 4.3);
    EXPECT_FALSE(p.x > 2 && p.x < 3.6 && p.y > 3 && p.y < 3.8);
  }
  for (const Point& local : sensors(task, TaskArea::kBackground).positions) {
    const Point p = local + origin;
    EXPECT_FALSE(p.x > 1.5 && p.x < 4.1 && p.y > 2.5 && p.y < 4.3);
    EXPECT_LT(p.y, 7.3);
  }
}

TEST(TaskAreas, ATaskInNoRoomIsRefusedWithTheRoomsThereAre) {
  Study study = task_room();
  study.tasks[0].rooms = "Aula*";
  const test::Stage stage(study);
  try {
    place_tasks(study, stage.scene, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("Aula*"), std::string::npos);
  }
}

TEST(TaskAreas, GridsHaveNamesOfTheirOwn) {
  const test::Stage stage(task_room());
  const auto tasks = place_tasks(task_room(), stage.scene, {"writing walls"});
  EXPECT_EQ(tasks[0].area(TaskArea::kWalls)->name, "writing walls (2)");
}

}  // namespace
}  // namespace clerestory::lighting
