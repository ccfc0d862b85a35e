// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/photometry.h"

#include <gtest/gtest.h>

#include <numbers>

namespace clerestory::lighting {
namespace {

using Symmetry = Photometry::Symmetry;
using Type = Photometry::Type;

/// Planes of so many candelas at all angles.
Photometry planes(Type type, Symmetry symmetry, std::vector<double> horizontal, const std::vector<double>& candela) {
  Photometry p;
  p.type = type;
  p.symmetry = symmetry;
  p.vertical_deg = type == Type::kC ? std::vector<double>{0, 90, 180} : std::vector<double>{-90, 0, 90};
  p.horizontal_deg = std::move(horizontal);
  for (const double cd : candela) p.candela.insert(p.candela.end(), 3, cd);
  return p;
}

TEST(WebOf, SymmetriesFillTheSphere) {
  const PhotometricWeb quadrants = web_of(planes(Type::kC, Symmetry::kQuadrants, {0, 90}, {10, 20}));
  const PhotometricWeb halves = web_of(planes(Type::kC, Symmetry::kMirrorC0, {0, 90, 180}, {10, 20, 30}));
  const PhotometricWeb across = web_of(planes(Type::kC, Symmetry::kMirrorC90, {-90, 0, 90}, {10, 20, 30}));
  for (const double c : {30.0, 150.0, 210.0, 330.0})
    EXPECT_NEAR(quadrants.intensity_cd(c, 60), 10.0 + 10.0 / 3.0, 1e-9);
  EXPECT_NEAR(halves.intensity_cd(270, 60), 20.0, 1e-9);
  EXPECT_NEAR(halves.intensity_cd(225, 60), 25.0, 1e-9);
  EXPECT_NEAR(across.intensity_cd(180, 60), 20.0, 1e-9);
  EXPECT_NEAR(across.intensity_cd(135, 60), 25.0, 1e-9);
  EXPECT_NEAR(across.intensity_cd(225, 60), 15.0, 1e-9);
}

TEST(WebOf, TypeAHasItsPolesAboveAndBelowAndCountsClockwise) {
  Photometry p = planes(Type::kA, Symmetry::kNone, {-90, 0, 90}, {1, 1, 1});
  // At V = 0: 10, 20, 30 cd.
  p.candela = {0, 10, 0, 0, 20, 0, 0, 30, 0};
  const PhotometricWeb web = web_of(p);
  EXPECT_NEAR(web.intensity_cd({1, 0, 0}), 20.0, 1e-9);   // H 0, V 0: photometric horizontal
  EXPECT_NEAR(web.intensity_cd({0, -1, 0}), 30.0, 1e-9);  // H 90, clockwise
  EXPECT_NEAR(web.intensity_cd({0, 1, 0}), 10.0, 1e-9);
  EXPECT_EQ(web.intensity_cd({0, 0, -1}), 0.0);  // V -90: straight down
  EXPECT_EQ(web.intensity_cd(normalized(mesh::Vector{-1, 0.1, 0})), 0.0);
}

TEST(WebOf, TypeBHasItsPolesAtC0AndC180) {
  Photometry p = planes(Type::kB, Symmetry::kMirrorC0, {0, 90}, {1, 1});
  // H 0: V -90, 0, 90; then H 90.
  p.candela = {5, 40, 7, 5, 20, 7};
  const PhotometricWeb web = web_of(p);
  EXPECT_NEAR(web.intensity_cd({0, 0, -1}), 40.0, 1e-9);  // H 0, V 0: straight down
  EXPECT_NEAR(web.intensity_cd({1, 0, 0}), 7.0, 1e-9);    // V 90
  EXPECT_NEAR(web.intensity_cd({-1, 0, 0}), 5.0, 1e-9);
  EXPECT_NEAR(web.intensity_cd({0, -1, 0}), 20.0, 1e-9);  // H 90
  EXPECT_NEAR(web.intensity_cd({0, 1, 0}), 20.0, 1e-9);   // H -90, alike
  EXPECT_NEAR(web.intensity_cd(normalized(mesh::Vector{0, -1, -1})), 30.0, 1e-9);
}

TEST(WebOf, UniformHalfSpheresHaveTheFluxOfOneWhateverTheType) {
  for (const Type type : {Type::kA, Type::kB}) {
    const auto p = planes(type, Symmetry::kMirrorC0, {0, 90}, {100, 100});
    EXPECT_NEAR(web_of(p).flux_lm(), 200.0 * std::numbers::pi, 1e-9);
  }
}

TEST(TiltTable, IsLinearAndEndsAtItsEnds) {
  const TiltTable tilt{.lamp_geometry = 1, .angles_deg = {0, 30, 90}, .multipliers = {1.0, 0.9, 0.6}};
  EXPECT_DOUBLE_EQ(tilt.at(0), 1.0);
  EXPECT_DOUBLE_EQ(tilt.at(15), 0.95);
  EXPECT_DOUBLE_EQ(tilt.at(60), 0.75);
  EXPECT_DOUBLE_EQ(tilt.at(120), 0.6);
}

}  // namespace
}  // namespace clerestory::lighting
