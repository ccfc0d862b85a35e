// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

EnergyBalance balance_of(const Study& study) {
  test::Solved solved(study);
  return energy_balance(solved.solution, solved.transport, 1);
}

TEST(EnergyBalance, NothingLeavesAClosedRoom) {
  Study study = test::study_of(support::box_room(4, 5, 3), 0.5, {2, 2, 1});
  test::shine(test::material(study, "ceiling"), 100.0);
  const EnergyBalance e = balance_of(study);
  EXPECT_NEAR(e.emitted_lm, 2000.0, 1e-3);
  EXPECT_EQ(e.received_lm, 0.0);
  EXPECT_NEAR(e.left_lm, 0.0, 1e-3);
  EXPECT_NEAR(e.absorbed_lm, 2000.0, 1.0);
  EXPECT_LT(std::abs(e.residual), 1e-3);
  EXPECT_LT(e.reciprocity, 1e-4);
  EXPECT_LT(e.closure, 1e-3);
}

TEST(EnergyBalance, AllOfALonePlatesLightLeaves) {
  mesh::Model model;
  support::add_quad(model, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {"plate", "plate"});
  Study study = test::study_of(std::move(model), 0.5, {1, 1, 1});
  study.grids[0].normals = {{0, 0, -1}};
  test::shine(test::material(study, "plate"), 100.0);
  const EnergyBalance e = balance_of(study);
  EXPECT_NEAR(e.emitted_lm, 400.0, 1e-3);
  EXPECT_EQ(e.absorbed_lm, 0.0);
  EXPECT_NEAR(e.left_lm, 400.0, 1e-3);
  EXPECT_NEAR(e.residual, 0.0, 1e-6);
}

TEST(EnergyBalance, WhatLeavesAnOpenBoxFollowsTheFormFactor) {
  mesh::Model model;
  const mesh::Model room = support::box_room(4, 4, 3);
  for (std::size_t p = 0; p < room.polygon_count(); ++p) {
    if (room.material_names[room.polygon_material[p].index()] == "ceiling") continue;
    std::vector<mesh::Point> outer;
    for (const std::uint32_t corner : room.loop(p)) outer.push_back(room.vertices[corner]);
    support::add_polygon(model, outer, {room.material_names[room.polygon_material[p].index()], "room"});
  }
  Study study = test::study_of(std::move(model), 0.0, {2, 2, 1});
  study.grids[0].normals = {{0, 0, -1}};
  test::shine(test::material(study, "floor"), 100.0);
  const EnergyBalance e = balance_of(study);
  const double through_the_top = 0.28273279 * 1600.0;
  EXPECT_NEAR(e.left_lm, through_the_top, 5.0);
  EXPECT_NEAR(e.absorbed_lm, 1600.0 - through_the_top, 2.0);
}

TEST(EnergyBalance, LampsFluxIsEmittedAndAbsorbed) {
  Study study = test::study_of(support::box_room(4, 5, 3), 0.5, {2, 2, 1});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({1.3, 2.1, 1.7}, 100.0));
  const EnergyBalance e = balance_of(study);
  EXPECT_NEAR(e.emitted_lm, 400.0 * std::numbers::pi, 1e-3);
  EXPECT_NEAR(e.received_lm, 0.0, 1e-3);
  EXPECT_NEAR(e.left_lm, 0.0, 1e-3);
  EXPECT_LT(std::abs(e.residual), 2e-3);
}

TEST(EnergyBalance, RoomWithAPaneIsInBalanceButForWhatTheGlassTakes) {
  mesh::Model model = support::box_room(4, 5, 3);
  support::add_quad(model, {0.5, 2.5, 0.3}, {3.5, 2.5, 0.3}, {3.5, 2.5, 2.7}, {0.5, 2.5, 2.7}, {"glass", "pane"});
  Study study = test::study_of(std::move(model), 0.5, {2, 2, 1});
  test::shine(test::material(study, "ceiling"), 100.0);
  double left_before = -1.0;
  for (const double transmittance : {0.918, 0.70, 0.30}) {
    test::glaze(test::material(study, "glass"), transmittance);
    const EnergyBalance e = balance_of(study);
    EXPECT_NEAR(e.emitted_lm, 2000.0, 1e-3);
    EXPECT_LT(std::abs(e.residual), 5e-3) << transmittance;
    EXPECT_LT(e.closure, 5e-3) << transmittance;
    EXPECT_GT(e.left_lm, left_before) << "darker glass takes more";
    if (transmittance == 0.918) {
      EXPECT_LT(e.left_lm, 5.0) << "glass that takes nothing";
    }
    left_before = e.left_lm;
  }
  EXPECT_GT(left_before, 100.0);
}

TEST(EnergyBalance, DarknessIsInBalance) {
  const EnergyBalance e = balance_of(test::study_of(support::facing_squares(), 0.5, {0.5, 0.5, 0.5}));
  EXPECT_EQ(e.emitted_lm, 0.0);
  EXPECT_EQ(e.left_lm, 0.0);
  EXPECT_EQ(e.residual, 0.0);
}

TEST(EnergyBalance, IsToldOfWhereItIsOffByMoreThanTheAccuracyAccountsFor) {
  EnergyBalance balance;
  balance.residual = 0.039;
  EXPECT_FALSE(imbalance_note(balance, 0.02));
  balance.residual = 0.084;
  EXPECT_NE(imbalance_note(balance, 0.02).value().find("8.4 % less"), std::string::npos);
  balance.residual = -0.084;
  EXPECT_NE(imbalance_note(balance, 0.02).value().find("8.4 % more"), std::string::npos);
  EXPECT_FALSE(imbalance_note(balance, 0.05));
}

}  // namespace
}  // namespace clerestory::lighting
