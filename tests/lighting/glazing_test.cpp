// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/glazing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clerestory::lighting {
namespace {

double transmittance_at_angle(const GlazingCurves& glazing, double degrees) {
  const auto cosine = static_cast<float>(std::cos(degrees * std::numbers::pi / 180.0));
  return mesh::transmittance_at(glazing.transmittance, cosine);
}

struct AtAngle {
  double degrees, transmittance;
};

TEST(Glazing, PaneOfSeventyPercentFollowsFresnel) {
  const GlazingCurves pane = glazing_curves(0.70, 1);
  for (const AtAngle& k : {AtAngle{0, .7000}, AtAngle{30, .6870}, AtAngle{50, .6495}, AtAngle{60, .6027},
                           AtAngle{70, .5040}, AtAngle{80, .2951}, AtAngle{85, .1349}}) {
    EXPECT_NEAR(transmittance_at_angle(pane, k.degrees), k.transmittance, 1e-4) << k.degrees;
  }
}

TEST(Glazing, PaneOfCie171FollowsItsTable) {
  const GlazingCurves pane = glazing_curves(0.88, 1);
  for (const AtAngle& k : {AtAngle{0, .8800}, AtAngle{15, .8793}, AtAngle{30, .8755}, AtAngle{45, .8599},
                           AtAngle{60, .7999}, AtAngle{70, .6839}, AtAngle{75, .5774}, AtAngle{80, .4235}}) {
    EXPECT_NEAR(transmittance_at_angle(pane, k.degrees), k.transmittance, 1e-4) << k.degrees;
  }
}

TEST(Glazing, HemisphericalOverNormalIsThatOfOneAndTwoPanes) {
  EXPECT_NEAR(glazing_curves(0.70, 1).hemispherical_transmittance / 0.70, 0.885, 5e-4);
  EXPECT_NEAR(glazing_curves(0.70, 2).hemispherical_transmittance / 0.70, 0.873, 5e-4);
}

TEST(Glazing, PaneOfSeventyPercentReflectsOnBothSides) {
  const GlazingCurves pane = glazing_curves(0.70, 1);
  EXPECT_NEAR(pane.reflectance.back(), 0.065, 5e-4);
  EXPECT_NEAR(pane.hemispherical_reflectance, 0.125, 5e-4);
}

TEST(Glazing, GrazingLightIsAllReflected) {
  for (const int panes : {1, 2, 3}) {
    const GlazingCurves pane = glazing_curves(0.6, panes);
    EXPECT_EQ(pane.transmittance.front(), 0.0F);
    EXPECT_EQ(pane.reflectance.front(), 1.0F);
  }
}

TEST(Glazing, TransmittanceAtNormalIncidenceIsTheUnits) {
  for (const int panes : {1, 2, 3}) {
    for (const double t : {0.05, 0.3, 0.6, 0.75}) {
      EXPECT_NEAR(glazing_curves(t, panes).transmittance.back(), t, 1e-6) << panes;
    }
  }
}

TEST(Glazing, NeverGivesMoreThanItGets) {
  for (const int panes : {1, 2, 3}) {
    for (const double t : {0.05, 0.6, 0.9, 0.99, 1.0}) {
      const GlazingCurves pane = glazing_curves(t, panes);
      EXPECT_TRUE(std::is_sorted(pane.transmittance.begin(), pane.transmittance.end()));
      for (std::size_t i = 0; i < pane.transmittance.size(); ++i) {
        EXPECT_LE(pane.transmittance[i] + pane.reflectance[i], 1.0F + 1e-6F);
        EXPECT_GE(pane.reflectance[i], 0.0F);
      }
    }
  }
}

TEST(Glazing, ClearSheetAbsorbsNothing) {
  // (1 − r)/(1 + r) with r = (0.52/2.52)²: 0.91832.
  const GlazingCurves pane = glazing_curves(0.9183246, 1);
  for (std::size_t i = 0; i < pane.transmittance.size(); ++i) {
    EXPECT_NEAR(pane.transmittance[i] + pane.reflectance[i], 1.0F, 2e-6F);
  }
}

TEST(Glazing, MoreThanAClearSheetTransmitsScalesItsWholeCurve) {
  const GlazingCurves clear = glazing_curves(0.9183246, 1);
  const GlazingCurves more = glazing_curves(0.95, 1);
  EXPECT_NEAR(more.transmittance.back(), 0.95, 1e-6);
  for (std::size_t i = 0; i < clear.transmittance.size(); ++i) {
    EXPECT_NEAR(more.transmittance[i], clear.transmittance[i] * 0.95 / 0.9183246, 1e-5);
  }
}

}  // namespace
}  // namespace clerestory::lighting
