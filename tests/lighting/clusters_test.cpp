// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lighting/sampling.h"
#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

/// Area of the room's surfaces, of both their sides: the outside is a place too.
constexpr double kSides_m2 = 2.0 * (40.0 + 24.0 + 30.0);

Study room_study() {
  Study study = test::study_of(support::box_room(4, 5, 3), 0.5, {2, 2, 1});
  test::shine(test::material(study, "ceiling"), 100.0);
  return study;
}

TEST(Clusters, LeavesHoldEveryRootOnce) {
  const test::Stage stage(room_study());
  const Clusters clusters(stage.scene, stage.solution.tree());
  std::map<std::uint32_t, int> seen;
  for (std::uint32_t c = 0; c < clusters.size(); ++c) {
    if (clusters.is_leaf(c)) ++seen[clusters.root(c).value];
  }
  EXPECT_EQ(seen.size(), stage.solution.tree().roots().size());
  for (const auto& [root, count] : seen) EXPECT_EQ(count, 1);
}

/// A room with a shining ceiling and a pane that hangs in its middle.
Study mixed_room() {
  mesh::Model model = support::box_room(4, 5, 3);
  support::add_quad(model, {1, 2.5, 1}, {3, 2.5, 1}, {3, 2.5, 2}, {1, 2.5, 2}, {"glass", "pane"});
  Study study = test::study_of(std::move(model), 0.5, {2, 2, 1});
  test::shine(test::material(study, "ceiling"), 100.0);
  test::glaze(test::material(study, "glass"));
  return study;
}

Clusters::Kind kind_of(const test::Stage& stage, mesh::ElementId root) {
  const mesh::FaceSide side = stage.solution.tree().face_side(root);
  if (stage.scene.is_pane(side)) return Clusters::Kind::kPanes;
  return stage.scene.shines(side) ? Clusters::Kind::kShining : Clusters::Kind::kPlain;
}

/// Counts the leaves of each kind below a cluster.
void count_kinds(const test::Stage& stage, const Clusters& clusters, std::uint32_t c,
                 std::map<Clusters::Kind, int>& counts) {
  if (clusters.is_leaf(c)) {
    ++counts[kind_of(stage, clusters.root(c))];
    return;
  }
  count_kinds(stage, clusters, clusters.left(c), counts);
  count_kinds(stage, clusters, clusters.right(c), counts);
}

TEST(Clusters, TopsAreOfOneKindEachAndHoldEveryRootBetweenThem) {
  const test::Stage stage(mixed_room());
  const Clusters clusters(stage.scene, stage.solution.tree());
  std::map<Clusters::Kind, int> all;
  for (const std::uint32_t top : clusters.tops()) {
    std::map<Clusters::Kind, int> of_one;
    count_kinds(stage, clusters, top, of_one);
    ASSERT_EQ(of_one.size(), 1U);
    EXPECT_EQ(of_one.begin()->first, clusters.kind(top));
    EXPECT_EQ(all.count(clusters.kind(top)), 0U) << "the biggest of its kind";
    all.insert(*of_one.begin());
  }
  std::map<Clusters::Kind, int> expected;
  for (const mesh::ElementId root : stage.solution.tree().roots()) ++expected[kind_of(stage, root)];
  EXPECT_EQ(all, expected);
  EXPECT_EQ(expected[Clusters::Kind::kPanes], 2) << "both sides";
  EXPECT_EQ(expected[Clusters::Kind::kShining], 1) << "the ceiling's front";
}

TEST(Clusters, WhatIsAllOfOneKindHasOneTop) {
  const test::Stage stage(test::study_of(support::box_room(4, 5, 3), 0.5, {2, 2, 1}));
  const Clusters clusters(stage.scene, stage.solution.tree());
  EXPECT_EQ(clusters.tops(), std::vector<std::uint32_t>{0});
  EXPECT_EQ(clusters.kind(0), Clusters::Kind::kPlain);
}

TEST(Clusters, AreasAddUpAndBoxesHoldTheirChildren) {
  const test::Stage stage(room_study());
  const Clusters clusters(stage.scene, stage.solution.tree());
  EXPECT_NEAR(clusters.area(0), kSides_m2, 1e-9);
  for (std::uint32_t c = 0; c < clusters.size(); ++c) {
    if (clusters.is_leaf(c)) continue;
    const std::uint32_t l = clusters.left(c);
    const std::uint32_t r = clusters.right(c);
    EXPECT_NEAR(clusters.area(l) + clusters.area(r), clusters.area(c), 1e-9);
    mesh::Box both = clusters.box(l);
    both.add(clusters.box(r));
    EXPECT_EQ(both.low, clusters.box(c).low);
    EXPECT_EQ(both.high, clusters.box(c).high);
    EXPECT_NEAR(clusters.radius(c), 0.5 * both.diagonal(), 1e-12);
  }
}

TEST(Clusters, SamplesAreUniformByArea) {
  const test::Stage stage(room_study());
  const mesh::ElementTree& tree = stage.solution.tree();
  const Clusters clusters(stage.scene, tree);
  const SobolPoints points(6);
  constexpr std::uint32_t kCount = 16384;
  for (std::uint32_t c = 0; c < clusters.size(); ++c) {
    std::map<std::uint32_t, int> counts;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const ClusterPoint p = clusters.sample(tree, c, points.at(i, 0), points.at(i, 1));
      ++counts[p.root.value];
      ASSERT_NEAR(dot(p.at - tree.centroid(p.root), p.normal), 0.0, 1e-9);
      EXPECT_EQ(p.normal.z, tree.normal(p.root).z);
    }
    for (const auto& [root, count] : counts) {
      EXPECT_NEAR(static_cast<double>(count) / kCount, tree.area(mesh::ElementId(root)) / clusters.area(c), 1e-3);
    }
  }
}

TEST(Clusters, TurnedAwayIsNoneOfWhichAnyPointFacesTheElement) {
  mesh::Model model = support::box_room(4, 5, 3);
  support::add_globe(model, {2, 2.5, 1.5}, 0.4, 16, 8, {"globe", "globe"});
  Study study = test::study_of(std::move(model), 0.5, {2, 2, 0.5});
  test::shine(test::material(study, "globe"), 100.0);
  const test::Stage stage(study);
  const mesh::ElementTree& tree = stage.solution.tree();
  const Clusters clusters(stage.scene, tree);
  const SobolPoints points(8);
  int turned = 0;
  int bundles = 0;
  for (const mesh::ElementId e : tree.roots()) {
    for (std::uint32_t c = 0; c < clusters.size(); ++c) {
      if (!clusters.is_turned_away(tree, c, e)) continue;
      ++turned;
      bundles += clusters.is_leaf(c) ? 0 : 1;
      for (std::uint32_t i = 0; i < 16; ++i) {
        const ClusterPoint q = clusters.sample(tree, c, points.at(i, 0), points.at(i, 1));
        const mesh::Vector to = q.at - tree.sample(e, points.at(i, 2), points.at(i, 3));
        EXPECT_LE(std::min(dot(to, tree.normal(e)), -dot(to, q.normal)), 1e-9) << c << " " << e.value;
      }
    }
  }
  // Of the globe's facets' backs, which see nothing but each other, and of fronts.
  EXPECT_GT(turned, 10'000);
  EXPECT_GT(bundles, 1'000);
}

TEST(Clusters, OneThatReachesInFrontOfAnElementIsNotTurnedAway) {
  mesh::Model model;
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {"floor", "floor"});
  support::add_quad(model, {0, 0, 3}, {0, 1, 3}, {1, 1, 3}, {1, 0, 3}, {"above", "above"});
  support::add_quad(model, {0, 0, -3}, {0, 1, -3}, {1, 1, -3}, {1, 0, -3}, {"below", "below"});
  const test::Stage stage(test::study_of(std::move(model), 0.5, {0.5, 0.5, 0.5}));
  const mesh::ElementTree& tree = stage.solution.tree();
  const Clusters clusters(stage.scene, tree);
  for (std::uint32_t c = 0; c < clusters.size(); ++c) {
    if (!clusters.is_leaf(c)) continue;
    const bool faces = clusters.root(c) == stage.root("above");
    EXPECT_EQ(clusters.is_turned_away(tree, c, stage.root("floor")), !faces) << c;
  }
}

TEST(Clusters, EndsOfTheUnitIntervalAreSampledToo) {
  const test::Stage stage(room_study());
  const mesh::ElementTree& tree = stage.solution.tree();
  const Clusters clusters(stage.scene, tree);
  for (const double a : {0.0, std::nextafter(1.0, 0.0)}) {
    const ClusterPoint p = clusters.sample(tree, 0, a, 0.5);
    EXPECT_TRUE(tree.find(tree.face_side(p.root), p.at).valid());
    EXPECT_NEAR(dot(p.at - tree.centroid(p.root), p.normal), 0.0, 1e-9);
  }
}

TEST(Clusters, PullGivesAreaMeansAndDeviations) {
  test::Stage stage(room_study());
  stage.solution.push_pull();  // no light but the ceiling's own
  Clusters clusters(stage.scene, stage.solution.tree());
  clusters.pull(stage.solution);
  const double share = 20.0 / kSides_m2;
  EXPECT_NEAR(clusters.radiosity_mean(0), 100.0 * share, 1e-3);
  EXPECT_NEAR(clusters.radiosity(0)[0], 100.0 * share, 1e-3);
  EXPECT_NEAR(clusters.radiosity_deviation(0), 100.0 * std::sqrt(share * (1.0 - share)), 1e-2);
  for (std::uint32_t c = 0; c < clusters.size(); ++c) {
    if (!clusters.is_leaf(c)) continue;
    EXPECT_EQ(clusters.radiosity_mean(c), stage.solution.radiosity_mean(clusters.root(c)));
  }
}

}  // namespace
}  // namespace clerestory::lighting
