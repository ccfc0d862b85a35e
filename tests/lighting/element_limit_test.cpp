// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/element_limit.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::ElementId;

/// A room of six roots, each a group of two triangles.
struct Room : test::Stage {
  Room() : Stage(test::study_of(support::box_room(4, 5, 3), 0.5, {2, 2, 1})), roots(solution.tree().roots()) {}

  bool open_by(const std::vector<ElementId>& nodes, const std::vector<double>& worths) {
    return open_worthiest(solution, nodes, [&](std::size_t i) { return worths.at(i); });
  }

  std::span<const ElementId> roots;
};

TEST(ElementLimit, OpensNothingWhereThereIsRoomForAll) {
  Room room;
  ASSERT_EQ(room.roots.size(), 6U);
  room.solution.limit_elements(8);
  EXPECT_TRUE(room.open_by({room.roots[0], room.roots[1], room.roots[0]}, {}));  // one of them is asked for twice
  EXPECT_EQ(room.solution.element_count(), 6U);
}

TEST(ElementLimit, OpensTheWorthiestAndLeavesNoRoomForTheRest) {
  Room room;
  room.solution.limit_elements(8);
  const std::vector<ElementId> nodes{room.roots[0], room.roots[1], room.roots[2], room.roots[3]};
  EXPECT_FALSE(room.open_by(nodes, {1.0, 3.0, 0.5, 2.0}));
  EXPECT_TRUE(room.solution.is_open(nodes[1]));
  EXPECT_TRUE(room.solution.is_open(nodes[3]));
  EXPECT_EQ(room.solution.elements_left(), 0U);
  for (const ElementId node : {nodes[0], nodes[2]}) EXPECT_FALSE(room.solution.may_open(node));
}

TEST(ElementLimit, OfEqualWorthTheFirstComesFirst) {
  Room room;
  room.solution.limit_elements(7);
  EXPECT_FALSE(room.open_by({room.roots[2], room.roots[0]}, {1.0, 1.0}));
  EXPECT_TRUE(room.solution.is_open(room.roots[2]));
  EXPECT_FALSE(room.solution.is_open(room.roots[0]));
}

TEST(ElementLimit, WhatIsOpenCostsNothing) {
  Room room;
  room.solution.open(room.roots[0]);
  room.solution.limit_elements(1);
  EXPECT_EQ(room.solution.elements_left(), 0U);
  EXPECT_TRUE(room.open_by({room.roots[0]}, {1.0}));
  EXPECT_FALSE(room.open_by({room.roots[1]}, {1.0}));
}

}  // namespace
}  // namespace clerestory::lighting
