// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "mesh/error.h"
#include "tests/io/study_folder.h"
#include "tests/support/places.h"

namespace clerestory::io {
namespace {

using lighting::Study;
using test::StudyFolder;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const lighting::Material& material(const Study& study, const std::string& name) {
  for (const auto& m : study.materials)
    if (m.name == name) return m;
  throw std::logic_error("no material " + name);
}

TEST(StudyFile, AModelAloneGetsEveryDefault) {
  const StudyFolder folder;
  const auto input = read_study(folder.model());
  const Study& study = input.study;
  EXPECT_EQ(study.name, "room");
  EXPECT_EQ(study.kind, Study::Kind::kIlluminance);
  EXPECT_EQ(study.sky.type, lighting::Sky::Type::kCieOvercast);
  EXPECT_EQ(study.sky.horizontal_illuminance_lux, 10'000.0);
  EXPECT_EQ(study.sky.ground_reflectance, 0.2);
  EXPECT_EQ(study.accuracy.target, 0.02);
  EXPECT_EQ(study.clean.repair, mesh::CleanOptions::Repair::kAuto);
  ASSERT_EQ(study.grids.size(), 1U);
  EXPECT_EQ(study.grids[0].name, "workplane");
  EXPECT_THAT(study.grids[0].surfaces, ElementsAre("rooms"));
  EXPECT_EQ(study.grids[0].height_m, 0.8);
  EXPECT_EQ(study.grids[0].spacing_m, 0.25);
  EXPECT_FALSE(study.grids[0].margin_m.has_value());
  EXPECT_THAT(study.assumptions, Contains(HasSubstr("Named like glass")));
  EXPECT_THAT(study.assumptions, Contains(HasSubstr("z axis points up")));
}

TEST(StudyFile, GlazingIsToldToTheCleanUp) {
  const StudyFolder folder;
  const auto input = read_study(folder.model());
  ASSERT_EQ(input.study.materials.size(), 3U);
  EXPECT_EQ(input.study.clean.sheet_materials, (std::vector<bool>{false, false, true}));
}

TEST(StudyFile, ReadsEveryTable) {
  const StudyFolder folder;
  test::write_text(folder.path() / "desk.pts", "1 1 0.8 0 0 2\n");
  const auto input = folder.read(R"(
[model]
file = "room.obj"
units = "cm"
up = "y"
north = 30
repair = "report"
[site]
latitude = 48.1
[materials.floor]
reflectance = [0.2, 0.3, 0.4]
[materials.floor.back]
reflectance = 0.6
[materials."glas*"]
glazing = { transmittance = 0.6, panes = 2 }
[materials.wall]
reflectance = 0.0
emission = { luminance_cd_m2 = 1000 }
[sky]
type = "uniform"
horizontal_illuminance = 5000
ground_reflectance = 0.1
[[grids]]
name = "desk"
points = "desk.pts"
[[grids]]
name = "floor"
surface = ["floor", "box"]
height = 0
spacing = "en12464"
margin = 0.3
[accuracy]
target = "5%"
)");
  const Study& study = input.study;
  EXPECT_EQ(study.model.vertices[2], (mesh::Point{0.06, 0.0, 0.08}));
  EXPECT_EQ(study.north_deg, 30.0);
  EXPECT_EQ(study.clean.repair, mesh::CleanOptions::Repair::kReport);
  EXPECT_THAT(*material(study, "floor").front.reflectance, ElementsAre(0.2F, 0.3F, 0.4F));
  EXPECT_THAT(*material(study, "floor").back.reflectance, ElementsAre(0.6F));
  EXPECT_EQ(material(study, "glass").glazing->transmittance_normal, 0.6);
  EXPECT_EQ(material(study, "glass").glazing->panes, 2);
  EXPECT_EQ(material(study, "wall").front.emission->luminance_cd_m2, 1000.0);
  EXPECT_FALSE(material(study, "wall").back.emission.has_value());
  EXPECT_EQ(study.sky.type, lighting::Sky::Type::kUniform);
  ASSERT_EQ(study.grids.size(), 2U);
  EXPECT_EQ(study.grids[0].normals[0].z, 1.0);
  EXPECT_TRUE(study.grids[1].en12464_spacing);
  EXPECT_EQ(study.grids[1].margin_m, 0.3);
  EXPECT_THAT(study.grids[1].surfaces, ElementsAre("floor", "box"));
  EXPECT_DOUBLE_EQ(study.accuracy.target, 0.05);
  EXPECT_EQ(input.input_files.size(), 4U);  // study, OBJ, MTL, sensors
  EXPECT_TRUE(study.assumptions.empty()) << study.assumptions.front();
}

TEST(StudyFile, TheExactNameCountsBeforePatternsAndOfTheseTheFirst) {
  const StudyFolder folder;
  const auto study = folder.read_materials(
      "'*' = { reflectance = 0.1 }\nwall = { reflectance = 0.2 }\n'floo?' = { reflectance = 0.3 }\n");
  EXPECT_THAT(*material(study, "wall").front.reflectance, ElementsAre(0.2F));
  EXPECT_THAT(*material(study, "floor").front.reflectance, ElementsAre(0.1F));
  EXPECT_THAT(*material(study, "glass").front.reflectance, ElementsAre(0.1F));
  EXPECT_FALSE(material(study, "glass").glazing.has_value());
  EXPECT_EQ(material(study, "wall").became, "reflectance 0.20");
  EXPECT_EQ(material(study, "wall").why, "the study");
  EXPECT_EQ(material(study, "floor").why, "the study's [materials.\"*\"]");
}

TEST(StudyFile, AFinishStandsForItsNumbers) {
  const StudyFolder folder;
  auto study = folder.read_materials("wall = { finish = \"white-paint\", back = { reflectance = 0.1 } }\n");
  EXPECT_THAT(*material(study, "wall").front.reflectance, ElementsAre(0.80F));
  EXPECT_THAT(*material(study, "wall").back.reflectance, ElementsAre(0.1F));
  EXPECT_EQ(material(study, "wall").why, "the study, finish white-paint");
  study = folder.read_materials("wall = { finish = \"single-glazing\" }\n");
  ASSERT_TRUE(material(study, "wall").glazing.has_value());
  EXPECT_EQ(material(study, "wall").glazing->transmittance_normal, 0.90);
}

TEST(StudyFile, TheBackMayHaveAFinishOfItsOwn) {
  const StudyFolder folder;
  const auto study = folder.read_materials("wall = { reflectance = 0.3, back = { finish = \"mirror\" } }\n");
  EXPECT_THAT(*material(study, "wall").front.reflectance, ElementsAre(0.3F));
  EXPECT_THAT(*material(study, "wall").back.reflectance, ElementsAre(0.99F));
  EXPECT_EQ(material(study, "wall").why, "the study, finish mirror on the back");
  EXPECT_THAT(study.assumptions, Contains(HasSubstr("The specular reflectance joins the diffuse one: material wall.")));
}

TEST(StudyFile, AMirrorOnBothSidesIsToldOnce) {
  const StudyFolder folder;
  const auto study = folder.read_materials("wall = { finish = \"mirror\", back = { finish = \"mirror\" } }\n");
  EXPECT_THAT(study.assumptions, Contains(HasSubstr("The specular reflectance joins the diffuse one: material wall.")));
}

TEST(StudyFile, AFinishThatIsUnknownOrToldTwiceIsRefused) {
  const StudyFolder folder;
  const auto message = [&](const std::string& entry) {
    try {
      static_cast<void>(folder.read_materials(entry));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("wall = { finish = \"whitepaint\" }\n"),
              HasSubstr("there is no finish 'whitepaint'; did you mean \"white-paint\"?"));
  EXPECT_THAT(message("wall = { finish = \"oak\", reflectance = 0.3 }\n"),
              HasSubstr("material 'wall' cannot have reflectance beside finish"));
  EXPECT_THAT(message("wall = { finish = \"oak\", glazing = { transmittance = 0.5 } }\n"),
              HasSubstr("cannot have finish beside glazing"));
  EXPECT_THAT(message("wall = { reflectance = 0.3, back = { finish = \"single-glazing\" } }\n"),
              HasSubstr("the back of material 'wall' cannot be glass alone"));
  EXPECT_THAT(message("wall = { reflectance = 0.3, back = { finish = \"oak\", reflectance = 0.3 } }\n"),
              HasSubstr("cannot have reflectance beside finish"));
}

TEST(StudyFile, AReflectanceThatHardlyAnySurfaceHasIsPointedOut) {
  const StudyFolder folder;
  const auto study = folder.read_materials("wall = { reflectance = 0.97 }\n");
  EXPECT_THAT(study.assumptions, Contains(HasSubstr("a reflectance over 0.95")));
}

TEST(StudyFile, TheGapGoesToTheCleanUp) {
  const StudyFolder folder;
  EXPECT_FALSE(read_study(folder.model()).study.clean.gap_m.has_value());
  EXPECT_EQ(read_study(folder.model(), {.set = {"model.gap=0.005"}}).study.clean.gap_m, 0.005);
}

TEST(StudyFile, SpecularJoinsTheDiffusePartAndSaysSo) {
  const StudyFolder folder;
  const auto study = folder.read_materials("wall = { reflectance = 0.05, specular = { reflectance = 0.6 } }\n");
  EXPECT_FLOAT_EQ(material(study, "wall").front.reflectance->front(), 0.65F);
  EXPECT_THAT(study.assumptions, Contains(HasSubstr("specular reflectance joins the diffuse one: material wall")));
}

TEST(StudyFile, OpeningsAreNeitherGlassNorWall) {
  const StudyFolder folder;
  const auto study = folder.read_materials("glass = { opening = true }\n");
  EXPECT_TRUE(material(study, "glass").opening);
  EXPECT_FALSE(material(study, "glass").glazing.has_value());
}

TEST(StudyFile, AnEntryForAMaterialThatOnlyTheMtlKnowsIsFine) {
  const StudyFolder folder;
  test::write_text(folder.path() / "room.mtl", "newmtl door\nKd 0.3 0.3 0.3\n");
  EXPECT_EQ(folder.read_materials("door = { reflectance = 0.3 }\n").materials.size(), 3U);
}

TEST(StudyFile, TheDaylightFactorTakesTheOvercastSkyAndSaysSo) {
  const StudyFolder folder;
  const auto input =
      folder.read("[model]\nfile = 'room.obj'\n[sky]\ntype = 'cie-clear'\ntime = 2026-03-21T12:00:00\nsun = true\n",
                  {.kind = Study::Kind::kDaylight, .set = {}});
  EXPECT_EQ(input.study.sky.type, lighting::Sky::Type::kCieOvercast);
  EXPECT_THAT(input.study.assumptions,
              Contains(HasSubstr("under the CIE overcast sky; the study's type = \"cie-clear\", time, sun in [sky]")));
  EXPECT_THAT(input.effective_json, Not(HasSubstr("cie-clear")));
}

TEST(StudyFile, TheDaylightFactorOfAnOvercastStudyAssumesNothingOfTheSky) {
  const StudyFolder folder;
  const auto input =
      folder.read("[model]\nfile = 'room.obj'\n[sky]\nsun = false\n", {.kind = Study::Kind::kDaylight, .set = {}});
  EXPECT_THAT(input.study.assumptions, Not(Contains(HasSubstr("sky"))));
}

TEST(StudyFile, TheDaylightFactorLeavesLampsDark) {
  const StudyFolder folder;
  const auto input = folder.read("[model]\nfile = 'room.obj'\n[materials.wall]\nemission = { flux_lm = 100 }\n",
                                 {.kind = Study::Kind::kDaylight, .set = {}});
  EXPECT_FALSE(material(input.study, "wall").front.emission.has_value());
  EXPECT_THAT(input.study.assumptions, Contains(HasSubstr("dark were left the lamps of wall")));
}

TEST(StudyFile, TheEffectiveStudyHoldsAllDefaultsAndReadsBackTheSame) {
  const StudyFolder folder;
  const auto input = folder.read("[model]\nfile = 'room.obj'\n[materials.glass.glazing]\n[accuracy]\ntarget = '4%'\n");
  const auto json = nlohmann::json::parse(input.effective_json);
  EXPECT_EQ(json["model"]["units"], "m");
  EXPECT_EQ(json["model"]["repair"], "auto");
  EXPECT_EQ(json["materials"]["glass"]["glazing"]["transmittance"], 0.70);
  EXPECT_EQ(json["sky"]["horizontal_illuminance"], 10000.0);
  EXPECT_EQ(json["grids"][0]["surface"], "rooms");
  EXPECT_EQ(json["accuracy"]["target"], 0.04);
}

TEST(StudyFile, OverridesApplyInOrderBeforeTheCheck) {
  const StudyFolder folder;
  const auto input =
      folder.read("[model]\nfile = 'room.obj'\n[[grids]]\nspacing = 1\n",
                  {.kind = Study::Kind::kIlluminance,
                   .set = {"accuracy.target=9%", "accuracy.target=0.1", "grids.0.spacing=0.5", "grids.1.name=second",
                           "sky.type=none", "materials.\"fl*\".reflectance=0.33", "materials.glass.opening = true"}});
  EXPECT_EQ(input.study.accuracy.target, 0.1);
  ASSERT_EQ(input.study.grids.size(), 2U);
  EXPECT_EQ(input.study.grids[0].spacing_m, 0.5);
  EXPECT_EQ(input.study.grids[1].name, "second");
  EXPECT_EQ(input.study.sky.type, lighting::Sky::Type::kNone);
  EXPECT_THAT(*material(input.study, "floor").front.reflectance, ElementsAre(0.33F));
  EXPECT_TRUE(material(input.study, "glass").opening);
}

TEST(StudyFile, OverridesApplyToAModelAlone) {
  const StudyFolder folder;
  const auto input =
      read_study(folder.model(), {.kind = Study::Kind::kIlluminance, .set = {"model.units=mm", "model.up=y"}});
  EXPECT_EQ(input.study.model.vertices[2], (mesh::Point{0.006, 0.0, 0.008}));
}

TEST(StudyFile, TheReferenceScenesReadWithoutAStudy) {
  CLERESTORY_NEEDS_VALIDATION("office");
  const auto input =
      read_study(test::validation_dir() / "office" / "scene.obj", {.kind = Study::Kind::kDaylight, .set = {}});
  EXPECT_TRUE(material(input.study, "glazing").glazing.has_value());
  EXPECT_THAT(*material(input.study, "ceiling").front.reflectance, ElementsAre(0.7F));
}

TEST(StudyFile, TheSampleReads) {
  const auto input =
      read_study(test::samples_dir() / "office" / "office.toml", {.kind = Study::Kind::kDaylight, .set = {}});
  EXPECT_FALSE(input.study.materials.empty());
}

TEST(StudyFile, GridsLookWhereTheyAreAskedTo) {
  const StudyFolder folder;
  const auto grids =
      folder
          .read(
              "[model]\nfile = 'room.obj'\nnorth = 90.0\n"
              "[[grids]]\nname = 'a'\ndirection = 'east'\n[[grids]]\nname = 'b'\ndirection = 'cylindrical'\n"
              "[[grids]]\nname = 'c'\ndirection = [0, 3, 4]\n[[grids]]\nname = 'd'\nmodelling = true\n")
          .study.grids;
  // North is 90° counter-clockwise from +y, -x; so east is +y.
  ASSERT_TRUE(grids[0].look.has_value());
  EXPECT_NEAR(grids[0].look->x, 0.0, 1e-12);
  EXPECT_NEAR(grids[0].look->y, 1.0, 1e-12);
  EXPECT_TRUE(grids[1].cylindrical && !grids[1].look);
  EXPECT_NEAR(grids[2].look->y, 0.6, 1e-12);
  EXPECT_TRUE(grids[3].modelling && !grids[3].cylindrical && !grids[3].look);
  EXPECT_EQ(grids[3].direction, "surface");
}

TEST(StudyFile, DirectionsThatAreNoneAreRefused) {
  const StudyFolder folder;
  for (const char* line : {"direction = 'up'", "direction = [0, 0, 0]", "direction = [1, 0]", "direction = 3",
                           "direction = 'north'\nmodelling = true"})
    EXPECT_THROW(folder.read(fmt::format("[model]\nfile = 'room.obj'\n[[grids]]\n{}\n", line)), InputError) << line;
}

}  // namespace
}  // namespace clerestory::io
