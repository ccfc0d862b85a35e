// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/observers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "lighting/ugr_table.h"
#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

constexpr double kSideM = 0.3;

/// A square panel that looks down, evenly bright from everywhere.
Luminaire panel(const Point& at, double axial_cd) {
  Luminaire lamp = clerestory::test::lambertian_lamp(at, {0, 0, -1}, axial_cd);
  lamp.opening = {.shape = LuminousOpening::Shape::kRectangle, .x_m = kSideM, .y_m = kSideM};
  return lamp;
}

/// A room with a panel below its ceiling, and somebody who looks along it.
Study panel_room(mesh::Model model = support::box_room(6, 8, 3)) {
  Study study = test::study_of(std::move(model), 0.5, {3, 1, 1.2});
  study.luminaires.push_back(panel({3, 5, 2.9}, 900.0));
  study.observers.push_back({"desk", {3, 1, 1.2}, {0, 1, 0}});
  return study;
}

ObserverResult seen_in(const Study& study) {
  const test::Solved solved(study);
  NoProgress nobody;
  return observe(solved.solution, solved.transport.errors, study.observers, study.accuracy.target, 1, nobody).at(0);
}

double expected_ugr(const ObserverResult& seen, double share) {
  const double r2 = 4.0 * 4.0 + 1.7 * 1.7;
  const Vector to = normalized(Vector{0, 4, 1.7});
  const double luminance = 900.0 / (kSideM * kSideM);
  const double solid_angle = share * kSideM * kSideM * to.z / r2;
  const double p = position_index({.eye = {}, .direction = {0, 1, 0}}, to);
  return 8.0 * std::log10(0.25 / seen.background_cd_m2 * luminance * luminance * solid_angle / (p * p));
}

TEST(Observers, UgrOfAPanelIsThatOfItsLuminanceSolidAngleAndPlace) {
  const ObserverResult seen = seen_in(panel_room());
  EXPECT_EQ(seen.glaring, 1U);
  EXPECT_EQ(seen.small + seen.large + seen.without_area, 0U);
  EXPECT_NEAR(seen.ugr, expected_ugr(seen, 1.0), 1e-3);
  EXPECT_GT(seen.ugr_error, 0.0);
  EXPECT_LT(seen.ugr_error, 0.2);
  ASSERT_TRUE(seen.room.has_value());
  EXPECT_EQ(*seen.room, 0U);
}

TEST(Observers, TheBackgroundIsTheIndirectLightAlone) {
  // A black room has none, and no UGR that is a number.
  Study study = panel_room();
  const double reflected = seen_in(study).background_cd_m2;
  EXPECT_GT(reflected, 1.0);
  for (Material& m : study.materials) m.front.reflectance = m.back.reflectance = Spectrum{0.0F};
  const ObserverResult black = seen_in(study);
  EXPECT_NEAR(black.background_cd_m2, 0.0, 1e-6);
  EXPECT_FALSE(std::isfinite(black.ugr));
}

TEST(Observers, WhatHidesHalfOfAPanelHalvesItsSolidAngle) {
  mesh::Model model = support::box_room(6, 8, 3);
  support::add_quad(model, {3, 4.5, 1.5}, {3, 4.5, 3}, {5, 4.5, 3}, {5, 4.5, 1.5}, {"screen", "screen"});
  const ObserverResult seen = seen_in(panel_room(std::move(model)));
  EXPECT_NEAR(seen.ugr, expected_ugr(seen, 0.5), 0.1);
}

TEST(Observers, PanelsBehindOrWithoutAreaDoNotGlare) {
  Study study = panel_room();
  study.observers[0].look = {0, -1, 0};
  EXPECT_FALSE(std::isfinite(seen_in(study).ugr));
  study.observers[0].look = {0, 1, 0};
  study.luminaires[0].opening = {};
  const ObserverResult point = seen_in(study);
  EXPECT_EQ(point.without_area, 1U);
  EXPECT_EQ(point.glaring, 0U);
}

TEST(Observers, ASurfaceThatShinesGlaresAsAPanelOfItsLuminance) {
  mesh::Model model = support::box_room(6, 8, 3);
  const double h = 0.5 * kSideM;
  support::add_quad(model, {3 - h, 5 - h, 2.9}, {3 - h, 5 + h, 2.9}, {3 + h, 5 + h, 2.9}, {3 + h, 5 - h, 2.9},
                    {"lamp", "lamp"});
  Study study = test::study_of(std::move(model), 0.5, {3, 1, 1.2});
  test::shine(test::material(study, "lamp"), std::numbers::pi * 900.0 / (kSideM * kSideM));
  study.observers.push_back({"desk", {3, 1, 1.2}, {0, 1, 0}});
  const ObserverResult seen = seen_in(study);
  EXPECT_EQ(seen.glaring, 1U);
  EXPECT_NEAR(seen.ugr, expected_ugr(seen, 1.0), 0.05);
}

TEST(Observers, AGlobeOfFacetsIsOneSource) {
  mesh::Model model = support::box_room(6, 8, 3);
  support::add_globe(model, {3, 5, 2.5}, 0.15, 24, 12, {"lamp", "globe"});
  Study study = test::study_of(std::move(model), 0.5, {3, 1, 1.2});
  test::material(study, "lamp").front.emission = Emission{.flux_lm = {}, .luminance_cd_m2 = 2000.0};
  study.observers.push_back({"desk", {3, 1, 1.2}, {0, 1, 0}});
  const ObserverResult seen = seen_in(study);
  EXPECT_EQ(seen.glaring, 1U);
  EXPECT_EQ(seen.small + seen.large, 0U);
  const double r2 = 4.0 * 4.0 + 1.3 * 1.3;
  const double solid_angle = std::numbers::pi * 0.15 * 0.15 / r2;
  const double p = position_index({.eye = {}, .direction = {0, 1, 0}}, normalized(Vector{0, 4, 1.3}));
  const double expected = 8.0 * std::log10(0.25 / seen.background_cd_m2 * 2000.0 * 2000.0 * solid_angle / (p * p));
  EXPECT_NEAR(seen.ugr, expected, 0.15) << "facets fill 0.98 of the disc";
}

TEST(Observers, AnEvenFieldOfLuminairesHasTheUgrOfTheTabularMethod) {
  // 4 H by 8 H, H = 2 m above the eye, a quarter of H apart; both ways of looking.
  Study study = test::study_of(support::box_room(8, 16, 3.2), 0.0, {4, 8, 1.2});
  for (std::size_t m = 0; m < study.materials.size(); ++m) {
    const std::string& name = study.model.material_names[m];
    const float rho = name == "ceiling" ? 0.7F : name == "floor" ? 0.2F : 0.5F;
    study.materials[m].front.reflectance = study.materials[m].back.reflectance = Spectrum{rho};
  }
  const Luminaire lamp = panel({}, 20.0);
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 32; ++j) {
      study.luminaires.push_back(lamp);
      study.luminaires.back().at = {0.25 + 0.5 * i, 0.25 + 0.5 * j, 3.19};
    }
  }
  study.accuracy.target = 0.3;
  study.observers = {{"along", {4, 0.001, 1.2}, {0, 1, 0}}, {"across", {0.001, 8, 1.2}, {1, 0, 0}}};
  const test::Solved solved(study);
  NoProgress nobody;
  const auto seen = observe(solved.solution, solved.transport.errors, study.observers, 0.3, 1, nobody);
  const UgrTable table = ugr_table(*lamp.web, lamp.opening, false);
  const auto row = [](double across, double along) {
    std::size_t r = 0;
    while (kUgrRooms[r].across != across || kUgrRooms[r].along != along) ++r;
    return r;
  };
  EXPECT_NEAR(seen[0].ugr, table[row(4, 8)][0], 0.5);
  EXPECT_NEAR(seen[1].ugr, table[row(8, 4)][0], 0.5);
}

}  // namespace
}  // namespace clerestory::lighting
