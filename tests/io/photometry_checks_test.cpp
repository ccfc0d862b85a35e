// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/photometry_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/io/refusal.h"

namespace clerestory::io {
namespace {

using lighting::Photometry;
using testing::HasSubstr;

/// 100 cd below the horizon.
Photometry lamp() {
  Photometry p;
  p.symmetry = Photometry::Symmetry::kAboutAxis;
  p.vertical_deg = {0, 90};
  p.horizontal_deg = {0};
  p.candela = {100, 100};
  p.opening = {.shape = lighting::LuminousOpening::Shape::kEllipse, .x_m = 0.1, .y_m = 0.1};
  p.lamps.emplace_back().flux_lm = 1000;
  return p;
}

TEST(CheckPhotometry, SaysNothingWhereAllIsWell) {
  Photometry p = lamp();
  p.stated_flux_lm = 200.0 * std::numbers::pi * 1.009;
  check_photometry(p, "lamp");
  EXPECT_TRUE(p.notes.empty());
}

TEST(CheckPhotometry, TellsAFluxThatIsNotTheStatedOne) {
  Photometry p = lamp();
  p.stated_flux_lm = 600.0;
  check_photometry(p, "lamp");
  EXPECT_THAT(p.notes.at(0), HasSubstr("add up to 628 lm, +4.7 % against the 600 lm"));
  EXPECT_THAT(p.notes.at(0), HasSubstr("do not belong together"));
  Photometry outshone = lamp();
  outshone.lamps[0].flux_lm = 500.0;
  check_photometry(outshone, "lamp");
  EXPECT_THAT(outshone.notes.at(0), HasSubstr("more than the 500 lm of its lamps"));
}

TEST(CheckPhotometry, TellsABeamThatIsNarrowForItsSteps) {
  Photometry p = lamp();
  p.vertical_deg = {0, 5, 10, 90};
  p.candela = {5000, 1000, 0, 0};
  p.stated_flux_lm = 0.9 * lighting::web_of(p).flux_lm();
  check_photometry(p, "lamp");
  EXPECT_THAT(p.notes.at(0), HasSubstr("narrow for the steps of its angles"));
}

TEST(CheckPhotometry, TellsAnglesThatAreMissing) {
  Photometry p = lamp();
  p.vertical_deg = {0, 85};
  check_photometry(p, "lamp");
  EXPECT_THAT(p.notes.at(0), HasSubstr("from 0 to 85 degrees"));
}

TEST(CheckPhotometry, RefusesALampWithoutLight) {
  Photometry p = lamp();
  p.candela = {0, 0};
  EXPECT_THAT(test::refusal_of([&] { check_photometry(p, "lamp.ies"); }), HasSubstr("lamp.ies: the intensities"));
}

}  // namespace
}  // namespace clerestory::io
