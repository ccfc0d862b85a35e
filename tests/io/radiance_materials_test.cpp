// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance_materials.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clerestory::io {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

SourceMaterial told(std::string_view type, std::vector<double> reals) {
  RadiancePrimitive material;
  material.type = type;
  material.kind = RadianceKind::kMaterial;
  material.identifier = "m";
  material.reals = std::move(reals);
  return tell_radiance_material(material).value();
}

auto near(double value) { return DoubleNear(value, 1e-12); }

TEST(RadianceMaterials, GlassGivesTransmissivityAndBecomesTransmittance) {
  EXPECT_NEAR(*told("glass", {0.654, 0.654, 0.654}).transmittance_normal, 0.600, 5e-4);
  EXPECT_NEAR(*told("glass", {0.76284, 0.76284, 0.76284}).transmittance_normal, 0.70, 1e-5);
  EXPECT_NEAR(*told("glass", {0.9584, 0.9584, 0.9584}).transmittance_normal, 0.88, 1e-4);
  EXPECT_NEAR(*told("glass", {1.0, 1.0, 1.0}).transmittance_normal, 0.918, 5e-4);
  EXPECT_EQ(*told("glass", {0.0, 0.0, 0.0}).transmittance_normal, 0.0);
  EXPECT_NEAR(*told("glass", {0.96, 0.96, 0.96, 1.0}).transmittance_normal, 0.96, 1e-12);
  EXPECT_GT(*told("glass", {1.2, 1.2, 1.2}).transmittance_normal, 1.0);
}

TEST(RadianceMaterials, PlasticSplitsIntoDiffuseAndSpecular) {
  const SourceMaterial wood = told("plastic", {0.544, 0.362, 0.208, 0.2, 0.08});
  EXPECT_THAT(*wood.diffuse, ElementsAre(near(0.8 * 0.544), near(0.8 * 0.362), near(0.8 * 0.208)));
  EXPECT_EQ(wood.specular, 0.2);
  EXPECT_TRUE(wood.photometric);
  EXPECT_EQ(wood.told_by, "the Radiance plastic");
}

TEST(RadianceMaterials, TheSpecularPartOfMetalHasItsColour) {
  const SourceMaterial gold = told("metal", {0.8, 0.6, 0.2, 0.9, 0.0});
  EXPECT_THAT(*gold.diffuse, ElementsAre(near(0.08), near(0.06), near(0.02)));
  EXPECT_NEAR(*gold.specular, 0.9 * (0.265 * 0.8 + 0.670 * 0.6 + 0.065 * 0.2), 1e-12);
}

TEST(RadianceMaterials, TransSplitsByItsSevenNumbers) {
  const SourceMaterial opal = told("trans", {0.8, 0.8, 0.8, 0.05, 0.0, 0.5, 0.2});
  const double passed = 0.95 * 0.5;
  EXPECT_THAT(*opal.diffuse,
              ElementsAre(near(0.8 * (0.95 - passed)), near(0.8 * (0.95 - passed)), near(0.8 * (0.95 - passed))));
  EXPECT_NEAR(*opal.translucent, 0.8 * 0.8 * passed, 1e-12);
  EXPECT_FALSE(opal.transmittance_normal.has_value());
  const SourceMaterial clear = told("trans", {0.9, 0.9, 0.9, 0.0, 0.0, 0.8, 1.0});
  EXPECT_NEAR(*clear.transmittance_normal, 0.72, 1e-12);
  EXPECT_FALSE(clear.translucent.has_value());
}

TEST(RadianceMaterials, LightsShineWith179LumensAWatt) {
  for (const char* type : {"light", "glow", "illum"}) {
    const SourceMaterial lamp = told(type, {100.0, 50.0, 10.0, 0.0});
    EXPECT_NEAR(*lamp.luminance_cd_m2, 179.0 * (26.5 + 33.5 + 0.65), 1e-9) << type;
    EXPECT_THAT(*lamp.diffuse, ElementsAre(0.0, 0.0, 0.0));
  }
  const SourceMaterial spot = told("spotlight", {100.0, 100.0, 100.0, 30.0, 0.0, 0.0, -1.0});
  EXPECT_FALSE(spot.luminance_cd_m2.has_value());
  EXPECT_TRUE(spot.shines);
}

TEST(RadianceMaterials, DielectricsAreClearPanesOfTheirIndex) {
  EXPECT_NEAR(*told("dielectric", {0.002, 0.002, 0.08, 1.5, 0.0}).transmittance_normal, 0.96 / 1.04, 1e-12);
  EXPECT_NEAR(*told("interface", {1, 1, 1, 1.5, 1, 1, 1, 1.0}).transmittance_normal, 0.96 / 1.04, 1e-12);
}

TEST(RadianceMaterials, MirrorsReflectSpecularlyAlone) {
  const SourceMaterial mirror = told("mirror", {0.9, 0.9, 0.9});
  EXPECT_NEAR(*mirror.specular, 0.9, 1e-12);
  EXPECT_THAT(*mirror.diffuse, ElementsAre(0.0, 0.0, 0.0));
}

TEST(RadianceMaterials, WhatIsNotUnderstoodTellsNothing) {
  const SourceMaterial bsdf = told("BSDF", {});
  EXPECT_FALSE(bsdf.photometric);
  EXPECT_FALSE(bsdf.diffuse.has_value());
  RadiancePrimitive short_one;
  short_one.type = "plastic";
  short_one.reals = {0.5, 0.5, 0.5};
  EXPECT_FALSE(tell_radiance_material(short_one).has_value());
}

}  // namespace
}  // namespace clerestory::io
