// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/material_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clerestory::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

SourceMaterial mtl(const std::string& name) { return {.name = name, .file = {}, .diffuse = {}, .opacity = {}}; }

TEST(MaterialRules, NamesOfGlassAreKnownInSeveralLanguages) {
  for (const char* name :
       {"glass", "Glass_01", "glazing", "Glas", "Isolierglas", "verre clair", "VIDRIO", "WindowGlass", "window pane",
        "Exterior_Window", "skylight", "Fenster-2", "DoubleGlazing", "safetyglass", "Vetro.001"})
    EXPECT_TRUE(is_named_like_glass(name)) << name;
}

TEST(MaterialRules, NamesThatOnlyContainGlassAreNot) {
  for (const char* name :
       {"window frame", "WindowSill", "fibreglass", "fiberglass insulation", "glass wool", "Glaswolle", "foamglass",
        "panel", "mirror glass", "hourglass", "glasfaser", "windowless", "Fensterrahmen", "fenster rahmen", "wall", ""})
    EXPECT_FALSE(is_named_like_glass(name)) << name;
}

TEST(MaterialRules, TheNameCountsBeforeTheMtl) {
  MaterialAssumptions assumed;
  SourceMaterial black_glass = mtl("glazing");
  black_glass.diffuse = {0.0, 0.0, 0.0};
  lighting::Material material;
  assumed.decide(black_glass, material);
  ASSERT_TRUE(material.glazing.has_value());
  EXPECT_EQ(material.glazing->transmittance_normal, 0.70);
  EXPECT_EQ(material.why, "named like glass");
}

TEST(MaterialRules, KdBecomesTheReflectanceOfBothSides) {
  MaterialAssumptions assumed;
  SourceMaterial red = mtl("brick");
  red.diffuse = {0.6, 0.3, 0.2};
  lighting::Material material;
  assumed.decide(red, material);
  EXPECT_THAT(*material.front.reflectance, ElementsAre(0.6F, 0.3F, 0.2F));
  EXPECT_EQ(material.back.reflectance, material.front.reflectance);
  red.told_by = "the base colour of the glTF";
  red.diffuse = {0.4, 0.4, 0.4};
  assumed.decide(red, material);
  EXPECT_THAT(*material.front.reflectance, ElementsAre(0.4F));
  EXPECT_EQ(material.why, "the base colour of the glTF");
  EXPECT_THAT(assumed.sentences(),
              testing::Contains("The base colour of the glTF was taken as diffuse reflectance, linear, without "
                                "a gamma to take off: material brick."));
}

TEST(MaterialRules, AGammaThatWasTakenOffIsTold) {
  MaterialAssumptions assumed;
  SourceMaterial red = mtl("brick");
  red.told_by = "the surface colour of the IFC";
  red.diffuse = {0.6, 0.3, 0.2};
  red.gamma_removed = true;
  lighting::Material material;
  assumed.decide(red, material);
  EXPECT_THAT(assumed.sentences(), ElementsAre(HasSubstr("after its gamma (sRGB) was taken off: material brick.")));
}

TEST(MaterialRules, KdOverWhatIsPossibleIsClampedAndTold) {
  MaterialAssumptions assumed;
  SourceMaterial white = mtl("white");
  white.diffuse = {1.0, 1.0, 1.0};
  lighting::Material material;
  assumed.decide(white, material);
  EXPECT_THAT(*material.front.reflectance, ElementsAre(0.95F));
  EXPECT_THAT(assumed.sentences(), testing::Contains(HasSubstr("outside 0 … 0.95")));
}

TEST(MaterialRules, WhatIsToldInPhotometricTermsCountsBeforeTheName) {
  MaterialAssumptions assumed;
  SourceMaterial frame = mtl("window");
  frame.diffuse = {0.4, 0.4, 0.4};
  frame.specular = 0.1;
  frame.photometric = true;
  frame.told_by = "the Radiance plastic";
  lighting::Material material;
  assumed.decide(frame, material);
  EXPECT_FALSE(material.glazing.has_value());
  EXPECT_THAT(*material.front.reflectance, ElementsAre(0.5F));
  EXPECT_EQ(material.why, "the Radiance plastic");
  EXPECT_THAT(assumed.sentences(), testing::Contains(HasSubstr("What the file says in photometric terms was taken")));
  EXPECT_THAT(assumed.sentences(), testing::Contains(HasSubstr("joins the diffuse one: material window")));
}

TEST(MaterialRules, ATransmittanceThatIsToldBecomesGlazing) {
  MaterialAssumptions assumed;
  SourceMaterial pane = mtl("pane 3");
  pane.transmittance_normal = 0.6;
  pane.told_by = "the Radiance glass";
  lighting::Material material;
  assumed.decide(pane, material);
  ASSERT_TRUE(material.glazing.has_value());
  EXPECT_EQ(material.glazing->transmittance_normal, 0.6);
  EXPECT_EQ(material.became, "glazing 0.60");
  EXPECT_EQ(material.why, "the Radiance glass");
  pane.transmittance_normal = 1.3;
  assumed.decide(pane, material);
  EXPECT_EQ(material.glazing->transmittance_normal, 1.0);
  EXPECT_THAT(assumed.sentences(), testing::Contains(HasSubstr("which no real surface has")));
  pane.transmittance_normal = 0.0;
  pane.photometric = true;
  lighting::Material black;
  assumed.decide(pane, black);
  EXPECT_FALSE(black.glazing.has_value());
}

TEST(MaterialRules, ALuminanceThatIsToldBecomesEmissionOfTheFront) {
  MaterialAssumptions assumed;
  SourceMaterial lamp = mtl("lamp");
  lamp.diffuse = {0.0, 0.0, 0.0};
  lamp.luminance_cd_m2 = 5000.0;
  lighting::Material material;
  assumed.decide(lamp, material);
  ASSERT_TRUE(material.front.emission.has_value());
  EXPECT_EQ(material.front.emission->luminance_cd_m2, 5000.0);
  EXPECT_FALSE(material.back.emission.has_value());
  EXPECT_EQ(material.became, "reflectance 0.00, shines with 5000 cd/m²");
}

TEST(MaterialRules, TranslucentMaterialsAreOpaqueAndItIsSaid) {
  MaterialAssumptions assumed;
  SourceMaterial opal = mtl("opal");
  opal.diffuse = {0.5, 0.5, 0.5};
  opal.translucent = 0.3;
  opal.photometric = true;
  lighting::Material material;
  assumed.decide(opal, material);
  EXPECT_THAT(*material.front.reflectance, ElementsAre(0.5F));
  EXPECT_THAT(assumed.sentences(), testing::Contains(HasSubstr("they are opaque: material opal (0.30)")));
}

TEST(MaterialRules, ReflectancesBelowZeroAreClampedAndTold) {
  MaterialAssumptions assumed;
  SourceMaterial odd = mtl("odd");
  odd.diffuse = {-0.2, -0.2, -0.2};
  lighting::Material material;
  assumed.decide(odd, material);
  EXPECT_THAT(*material.front.reflectance, ElementsAre(0.0F));
  EXPECT_THAT(assumed.sentences(), testing::Contains(HasSubstr("outside 0")));
}

TEST(MaterialRules, TransparentMaterialsBecomeGlazing) {
  MaterialAssumptions assumed;
  SourceMaterial clear = mtl("Material.003");
  clear.diffuse = {0.8, 0.8, 0.8};
  clear.opacity = 0.2;
  lighting::Material material;
  assumed.decide(clear, material);
  EXPECT_TRUE(material.glazing.has_value());
  clear.opacity = 0.7;
  lighting::Material milky;
  assumed.decide(clear, milky);
  EXPECT_FALSE(milky.glazing.has_value());
}

TEST(MaterialRules, NothingKnownLeavesItToTheOrientation) {
  MaterialAssumptions assumed;
  lighting::Material material;
  assumed.decide(mtl("stuff"), material);
  EXPECT_FALSE(material.front.reflectance.has_value());
  EXPECT_FALSE(material.glazing.has_value());
  SourceMaterial textured = mtl("pattern");
  textured.diffuse = {0.0, 0.0, 0.0};
  textured.textured = true;
  assumed.decide(textured, material);
  EXPECT_FALSE(material.front.reflectance.has_value());
  EXPECT_THAT(assumed.sentences(),
              ElementsAre(HasSubstr("Textures are not read"), HasSubstr("Nothing says what they are made of")));
}

TEST(MaterialRules, ANameTellsTheFinishWhereTheFileTellsNoColour) {
  MaterialAssumptions assumed;
  lighting::Material material;
  SourceMaterial carpet = mtl("carpet 3");
  carpet.textured = true;
  assumed.decide(carpet, material);
  EXPECT_THAT(*material.front.reflectance, ElementsAre(0.20F));
  EXPECT_EQ(material.became, "reflectance 0.20");
  EXPECT_EQ(material.why, "named like carpet");
  EXPECT_THAT(assumed.sentences(),
              ElementsAre("Named like carpet, and so with a reflectance of 0.20: material carpet 3."));
}

TEST(MaterialRules, EachAssumptionIsToldOnceForAllMaterials) {
  MaterialAssumptions assumed;
  for (const char* name : {"glass 1", "glass 2"}) {
    lighting::Material material;
    assumed.decide(mtl(name), material);
  }
  EXPECT_THAT(assumed.sentences(), ElementsAre(HasSubstr("materials glass 1, glass 2.")));
}

}  // namespace
}  // namespace clerestory::io
