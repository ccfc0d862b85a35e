// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminaire_sampler.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;

/// A Lambertian point lamp 1.5 m above the floor of a black hall of 20 m x 20 m x 3 m: half of its flux falls on 2 % of the floor.
Study hall_with_low_lamp() {
  Study study = test::study_of(support::box_room(20, 20, 3), 0.0, {1, 1, 1});
  study.luminaires.push_back(clerestory::test::lambertian_lamp({7, 9, 1.5}, {0, 0, -1}, 1000.0));
  return study;
}

/// Of the lamp's flux, that falls on the floor and not on the walls: E = I_0 h² / r⁴ summed by squares of 1 cm.
double floor_share() {
  double sum = 0.0;
  for (double x = 0.005; x < 20.0; x += 0.01) {
    for (double y = 0.005; y < 20.0; y += 0.01) {
      const double r2 = (x - 7.0) * (x - 7.0) + (y - 9.0) * (y - 9.0) + 1.5 * 1.5;
      sum += 1e-4 * 1.5 * 1.5 / (r2 * r2);
    }
  }
  return sum / std::numbers::pi;
}

TEST(LuminaireSampler, BringsTheFluxOnANodeToItsTolerance) {
  const test::Stage stage(hall_with_low_lamp());
  const double all_lm = std::numbers::pi * 1000.0;
  const mesh::ElementId floor = stage.root("floor");
  const LuminaireSampler sampler(stage.solution, 1, 0.02 * all_lm);
  GroupSums none;
  // However little the node matters to the sensors.
  const ReplicateMean mean = sampler.mean(floor, any_luminaires(stage.scene), 1e9, none);
  const double floor_lm = floor_share() * all_lm;
  EXPECT_NEAR(400.0 * mean.mean, floor_lm, 3.0 * 0.02 * all_lm);
  EXPECT_LE(400.0 * mean.standard_error(), 0.02 * all_lm);
}

/// A black room of 4 m x 4 m x 3 m with a panel at (2, 2, 2.5), and a board half-way up over x > 2.5.
Study room_with_board() {
  mesh::Model model = support::box_room(4, 4, 3);
  support::add_quad(model, {2.5, 0, 1.25}, {4, 0, 1.25}, {4, 4, 1.25}, {2.5, 4, 1.25}, {"board", "board"});
  Study study = test::study_of(std::move(model), 0.0, {1, 1, 1});
  Luminaire panel = clerestory::test::lambertian_lamp({2, 2, 2.5}, {0, 0, -1}, 1000.0);
  panel.opening = {.shape = LuminousOpening::Shape::kRectangle, .x_m = 0.6, .y_m = 0.3};
  study.luminaires.push_back(panel);
  return study;
}

mesh::ShaftEnd floor_piece(const test::Stage& stage, double x0, double x1) {
  mesh::ShaftEnd piece;
  piece.corners = {stage.local({x0, 1, 0}), stage.local({x1, 1, 0}), stage.local({x1, 3, 0}), stage.local({x0, 3, 0})};
  piece.count = 4;
  piece.normal = {0, 0, 1};
  return piece;
}

TEST(Narrowed, ProvesWhatIsClearAndWhatIsHiddenAndKeepsWhatStandsBetween) {
  const test::Stage stage(room_with_board());
  const std::vector<LuminaireView> any = any_luminaires(stage.scene);
  ASSERT_EQ(any.size(), 1U);
  EXPECT_FALSE(any[0].known);

  const auto open = narrowed(stage.scene, floor_piece(stage, 0.5, 1.0), any);
  ASSERT_EQ(open.size(), 1U);
  EXPECT_TRUE(open[0].clear());

  const auto partly = narrowed(stage.scene, floor_piece(stage, 2.5, 3.0), any);
  ASSERT_EQ(partly.size(), 1U);
  EXPECT_TRUE(partly[0].known);
  EXPECT_EQ(partly[0].before.size(), 1U);

  EXPECT_TRUE(narrowed(stage.scene, floor_piece(stage, 3.5, 3.9), any).empty());
}

TEST(Narrowed, LeavesOutWhatLiesBehind) {
  const test::Stage stage(room_with_board());
  mesh::ShaftEnd ceiling = floor_piece(stage, 0.5, 1.0);
  for (Point& p : ceiling.corners) p.z += 2.0;
  ceiling.normal = {0, 0, 1};
  EXPECT_FALSE(narrowed(stage.scene, ceiling, any_luminaires(stage.scene)).empty());
  ceiling.normal = {0, 0, -1};
  EXPECT_TRUE(narrowed(stage.scene, ceiling, any_luminaires(stage.scene)).empty());
}

}  // namespace
}  // namespace clerestory::lighting
