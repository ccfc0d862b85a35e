// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance_modifiers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clerestory::io {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

RadiancePrimitive primitive(RadianceKind kind, const std::string& modifier, std::string_view type,
                            const std::string& identifier, std::vector<std::string> strings,
                            std::vector<double> reals) {
  return {modifier, type, kind, identifier, std::move(strings), std::move(reals), 5};
}

class RadianceModifiersTest : public testing::Test {
 protected:
  void plastic(const std::string& name, double grey, const std::string& file = "a.rad",
               const std::string& modifier = "void") {
    modifiers_.define(primitive(RadianceKind::kMaterial, modifier, "plastic", name, {}, {grey, grey, grey, 0.0, 0.0}),
                      file);
  }
  void define(RadianceKind kind, const std::string& modifier, std::string_view type, const std::string& name,
              std::vector<std::string> strings = {}, std::vector<double> reals = {}) {
    modifiers_.define(primitive(kind, modifier, type, name, std::move(strings), std::move(reals)), "a.rad");
  }
  SourceMaterial told(const std::string& name) {
    for (const SourceMaterial& material : modifiers_.told())
      if (material.name == name) return material;
    ADD_FAILURE() << "nothing is told of " << name;
    return {};
  }
  double grey(const std::string& name) { return told(name).diffuse.value_or(std::array{-1.0, -1.0, -1.0})[0]; }

  RadianceModifiers modifiers_;
};

TEST_F(RadianceModifiersTest, ANameMeansItsLatestDefinition) {
  plastic("wood", 0.3, "desk.rad");
  EXPECT_EQ(modifiers_.material_for("wood"), "wood");
  plastic("wood", 0.6, "lib/chair.rad");
  EXPECT_EQ(modifiers_.material_for("wood"), "wood (chair)");
  plastic("wood", 0.3, "desk.rad");
  EXPECT_EQ(modifiers_.material_for("wood"), "wood");
  EXPECT_EQ(grey("wood"), 0.3);
  EXPECT_EQ(grey("wood (chair)"), 0.6);
  EXPECT_EQ(modifiers_.told().size(), 2U);
}

TEST_F(RadianceModifiersTest, AnAliasHasTheMaterialOfItsTarget) {
  plastic("white", 0.8);
  define(RadianceKind::kAlias, "void", "alias", "ceiling", {"white"});
  EXPECT_EQ(modifiers_.material_for("ceiling"), "ceiling");
  EXPECT_EQ(grey("ceiling"), 0.8);
  EXPECT_EQ(told("ceiling").told_by, "the Radiance plastic 'white'");
}

TEST_F(RadianceModifiersTest, PatternsAndTexturesLeadToTheMaterialBehindThem) {
  plastic("tile", 0.4);
  define(RadianceKind::kTexture, "tile", "texfunc", "bumps", {"a", "b", "c", "d.cal"});
  define(RadianceKind::kPattern, "bumps", "brightfunc", "dirt", {"dirty", "dirt.cal"});
  EXPECT_EQ(modifiers_.material_for("bumps"), "tile");
  EXPECT_EQ(modifiers_.material_for("dirt"), "tile");
  EXPECT_THAT(modifiers_.notices(),
              ElementsAre(HasSubstr("Patterns are not read, and what lies behind them counts: tile")));
}

TEST_F(RadianceModifiersTest, ALightBehindAPatternHasNoKnownLuminance) {
  define(RadianceKind::kPattern, "void", "brightdata", "dist", {"flatcorr", "x.dat"});
  define(RadianceKind::kMaterial, "dist", "light", "lamp", {}, {100.0, 100.0, 100.0});
  EXPECT_EQ(modifiers_.material_for("lamp"), "lamp");
  EXPECT_TRUE(told("lamp").shines);
  EXPECT_FALSE(told("lamp").luminance_cd_m2.has_value());
}

TEST_F(RadianceModifiersTest, APictureIsAllOfTheColour) {
  define(RadianceKind::kPattern, "void", "colorpict", "photo", {"red", "green", "blue", "photo.hdr"});
  plastic("print", 1.0, "a.rad", "photo");
  modifiers_.material_for("print");
  EXPECT_TRUE(told("print").textured);
}

TEST_F(RadianceModifiersTest, AMixtureCountsAsItsFirstPart) {
  plastic("red", 0.2);
  plastic("blue", 0.7);
  define(RadianceKind::kMixture, "void", "mixfunc", "checks", {"red", "blue", "check", "check.cal"});
  define(RadianceKind::kMixture, "void", "mixfunc", "holes", {"void", "blue", "check", "check.cal"});
  EXPECT_EQ(modifiers_.material_for("checks"), "checks");
  EXPECT_EQ(modifiers_.material_for("holes"), "holes");
  EXPECT_EQ(grey("checks"), 0.2);
  EXPECT_EQ(grey("holes"), 0.7);
  EXPECT_THAT(modifiers_.notices(), Contains(HasSubstr("A mixture counts as its first part: checks, holes")));
}

TEST_F(RadianceModifiersTest, AnIllumCountsAsTheMaterialBehindIt) {
  define(RadianceKind::kMaterial, "void", "glass", "pane", {}, {0.654, 0.654, 0.654});
  define(RadianceKind::kMaterial, "void", "illum", "window", {"pane"}, {1.0, 1.0, 1.0});
  define(RadianceKind::kMaterial, "void", "illum", "lamp", {}, {1.0, 1.0, 1.0});
  modifiers_.material_for("window");
  modifiers_.material_for("lamp");
  EXPECT_NEAR(told("window").transmittance_normal.value_or(0.0), 0.600, 5e-4);
  EXPECT_NEAR(told("lamp").luminance_cd_m2.value_or(0.0), 179.0, 1e-9);
}

TEST_F(RadianceModifiersTest, SurfacesOfAntimatterAndMistAreNone) {
  define(RadianceKind::kMaterial, "void", "antimatter", "cut", {"wall"});
  define(RadianceKind::kMaterial, "void", "mist", "fog");
  EXPECT_FALSE(modifiers_.material_for("cut").has_value());
  EXPECT_FALSE(modifiers_.material_for("fog").has_value());
}

TEST_F(RadianceModifiersTest, UndefinedNamesStayAndAreTold) {
  EXPECT_EQ(modifiers_.material_for("steel"), "steel");
  EXPECT_EQ(modifiers_.material_for("void"), "default");
  EXPECT_THAT(modifiers_.notices(), ElementsAre(HasSubstr("No file of the scene defines these materials")));
  plastic("steel", 0.5);  // Radiance wants it before its use; we do not insist
  EXPECT_EQ(grey("steel"), 0.5);
  EXPECT_TRUE(modifiers_.notices().empty());
}

}  // namespace
}  // namespace clerestory::io
