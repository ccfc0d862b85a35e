// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/lookers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "mesh/progress.h"
#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::ElementId;

constexpr double kScaleLux = 100.0;

/// Boxes of 20 cm all over the floor of a room, so that there are several hundred roots; one sensor near the ceiling looks at it.
Study crowded_room() {
  mesh::Model model = support::box_room(6, 6, 3);
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      const mesh::Point low{0.5 + 0.65 * x, 0.5 + 0.65 * y, 0.1};
      support::add_box(model, low, low + mesh::Vector{0.2, 0.2, 0.2}, {"box", "box"});
    }
  }
  Study study = test::study_of(std::move(model), 0.5, {3, 3, 2});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({1, 1, 2}, 1000.0));
  return study;
}

struct Found {
  explicit Found(double goal_lux) : stage(crowded_room()) {
    const Importance importance(stage.solution, stage.walks(1));
    NoProgress unwatched;
    receivers = find_receivers(stage.solution, importance, {kScaleLux, goal_lux, 1}, unwatched);
  }

  [[nodiscard]] bool looks(ElementId node) const {
    for (const Looker& looker : receivers.lookers) {
      if (looker.node == node) return true;
    }
    return false;
  }
  [[nodiscard]] bool links(ElementId node) const {
    return std::find(receivers.linking.begin(), receivers.linking.end(), node) != receivers.linking.end();
  }

  test::Stage stage;
  Receivers receivers;
};

TEST(FindReceivers, EachRootLooksLinksOrIsWhollyMadeOfPartsThatLook) {
  for (const double goal : {30.0, 1.0, 0.1, 1e-4}) {
    const Found found(goal);
    const mesh::ElementTree& tree = found.stage.solution.tree();
    double all = 0.0;
    for (const ElementId root : tree.roots()) all += tree.area(root);
    double received = 0.0;
    std::set<std::uint32_t> nodes;
    for (const ElementId root : found.receivers.linking) {
      received += tree.area(root);
      nodes.insert(root.value);
    }
    for (const Looker& looker : found.receivers.lookers) {
      received += tree.area(looker.node);
      nodes.insert(looker.node.value);
      EXPECT_GT(looker.view.rays, 0U);
    }
    EXPECT_NEAR(received, all, 1e-9 * all) << goal;
    EXPECT_EQ(nodes.size(), found.receivers.linking.size() + found.receivers.lookers.size()) << goal;
  }
}

TEST(FindReceivers, WhereMuchMayBeMissedAllRootsLookAsTheyAre) {
  const Found found(1000.0);
  EXPECT_TRUE(found.receivers.linking.empty());
  EXPECT_EQ(found.receivers.lookers.size(), found.stage.solution.tree().roots().size());
  for (const Looker& looker : found.receivers.lookers) EXPECT_EQ(looker.view.rays, 32U);
}

TEST(FindReceivers, WhatMattersMostLooksByItsPartsWhereManySurfacesSurroundIt) {
  const Found found(1.0);
  const ElementId ceiling = found.stage.root("ceiling");
  EXPECT_TRUE(found.stage.solution.is_open(ceiling));
  EXPECT_FALSE(found.links(ceiling));
  EXPECT_FALSE(found.looks(ceiling));
  EXPECT_TRUE(found.receivers.linking.empty());
}

TEST(FindReceivers, WhereLittleMayBeMissedLinksCostLess) {
  const Found found(1e-4);
  EXPECT_TRUE(found.links(found.stage.root("ceiling")));
}

}  // namespace
}  // namespace clerestory::lighting
