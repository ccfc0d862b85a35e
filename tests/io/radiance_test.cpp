// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/clean.h"
#include "tests/io/refusal.h"
#include "tests/support/places.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

namespace fs = std::filesystem;
using test::refusal_of;
using test::write_text;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr const char* kWall = "void plastic paint 0 0 5 .5 .5 .5 0 0\n";
constexpr const char* kSquare = "paint polygon square.1 0 0 12 0 0 0 1 0 0 1 1 0 0 1 0\n";

mesh::Vector doubled_area(const mesh::Model& model, std::size_t polygon) {
  mesh::Vector sum;
  const auto loop = model.loop(polygon);
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum = sum + mesh::cross(model.vertices[loop[i]] - model.vertices[loop[0]],
                            model.vertices[loop[i + 1]] - model.vertices[loop[0]]);
  return sum;
}

class Radiance : public testing::Test {
 protected:
  fs::path beside(const std::string& name) { return folder_.path() / name; }
  ModelFile read(const std::string& text) {
    write_text(beside("room.rad"), text);
    return read_radiance(beside("room.rad"));
  }
  std::string refusal(const std::string& text) {
    return refusal_of([&] { read(text); });
  }

  test::ScratchFolder folder_;
};

TEST_F(Radiance, SurfacesHaveMaterialPartAndLine) {
  const ModelFile file = read(std::string(kWall) + kSquare + "paint polygon lid 0 0 9 0 0 1 1 0 1 1 1 1\n");
  ASSERT_EQ(file.model.polygon_count(), 2U);
  EXPECT_THAT(file.model.material_names, ElementsAre("paint"));
  EXPECT_THAT(file.model.part_names, ElementsAre("square", "room"));
  EXPECT_THAT(file.model.polygon_line, ElementsAre(2U, 3U));
  ASSERT_EQ(file.materials.size(), 1U);
  EXPECT_THAT(*file.materials[0].diffuse, ElementsAre(0.5, 0.5, 0.5));
  EXPECT_EQ(file.materials[0].line, 1U);
  EXPECT_THAT(file.notices, ElementsAre(HasSubstr("was taken as m from the model's size")));
}

TEST_F(Radiance, IncludedFilesAreFoundBesideTheirOwnAndBesideTheFirst) {
  fs::create_directory(beside("lib"));
  write_text(beside("lib/set.rad"), "!xform -n b -t 10 0 0 chair.rad\n!xform desk.rad\n");
  write_text(beside("lib/chair.rad"), kSquare);
  write_text(beside("desk.rad"), kSquare);
  const ModelFile file = read(std::string(kWall) + "!xform -n a -t 0 0 5 lib/set.rad\n!cat desk.rad\n");
  EXPECT_THAT(file.model.part_names, ElementsAre("a.b", "a.desk", "desk"));
  EXPECT_THAT(file.model.vertices, Contains(mesh::Point{11.0, 1.0, 5.0}));
  EXPECT_EQ(file.files.size(), 4U);
  EXPECT_THAT(file.model.polygon_line, ElementsAre(0U, 0U, 0U));
}

TEST_F(Radiance, ArraysMakeAPartACopy) {
  write_text(beside("desk.rad"), kSquare);
  const ModelFile file = read(std::string(kWall) + "!xform -a 3 -t 2 0 0 desk.rad\n");
  EXPECT_THAT(file.model.part_names, ElementsAre("desk.0", "desk.1", "desk.2"));
}

TEST_F(Radiance, MirroredSurfacesKeepTheirFronts) {
  write_text(beside("up.rad"), std::string(kSquare) + "paint ring hole.1 0 0 8 0 0 0 0 0 1 .5 1\n");
  const ModelFile file = read(std::string(kWall) + "!xform -mx up.rad\n!xform -s -1 up.rad\n!xform -I up.rad\n");
  ASSERT_EQ(file.model.polygon_count(), 6U);
  EXPECT_GT(doubled_area(file.model, 0).z, 0.0);
  EXPECT_GT(doubled_area(file.model, 1).z, 0.0);
  EXPECT_LT(doubled_area(file.model, 2).z, 0.0);  // turned upside down
  EXPECT_LT(doubled_area(file.model, 4).z, 0.0);
  EXPECT_LT(doubled_area(file.model, 5).z, 0.0);
  EXPECT_EQ(file.model.loop_count(5), 2U);
}

TEST_F(Radiance, TheModifierOfXformCountsForAllSurfaces) {
  write_text(beside("desk.rad"), kSquare);
  const ModelFile file = read(std::string(kWall) + "void metal steel 0 0 5 .6 .6 .6 .9 0\n!xform -m steel desk.rad\n");
  EXPECT_THAT(file.model.material_names, ElementsAre("steel"));
  EXPECT_THAT(file.unused_materials, ElementsAre("paint"));
}

TEST_F(Radiance, WhatIsLeftOutIsTold) {
  const ModelFile file = read(std::string(kWall) + kSquare +
                              "!gensky 12 21 12 -c | xform -rz 90\n"
                              "void glow sky_glow 0 0 4 1 1 1 0\nsky_glow source sky 0 0 4 0 0 1 180\n"
                              "void instance tree 1 tree.oct 0 0\nvoid antimatter cut 1 paint 0 0\n"
                              "cut sphere bite 0 0 4 0 0 0 1\npaint sphere dot 0 0 4 0 0 0 0\n");
  EXPECT_EQ(file.model.polygon_count(), 1U);
  EXPECT_THAT(file.notices, Contains(HasSubstr("Commands that make a sky were left out")));
  EXPECT_THAT(file.notices, Contains(HasSubstr("Distant sources were left out")));
  EXPECT_THAT(file.notices,
              Contains(HasSubstr("Instances of octrees and meshes were left out: 1, the first is 'tree'")));
  EXPECT_THAT(file.notices, Contains(HasSubstr("antimatter and mist were left out: 1, the first is 'bite'")));
  EXPECT_THAT(file.notices, Contains(HasSubstr("whose numbers make no surface were left out: 1, the first is 'dot'")));
}

TEST_F(Radiance, ScenesThatIncludeThemselvesAreRefused) {
  EXPECT_THAT(refusal("!xform -t 0 0 1 room.rad\n"), HasSubstr("room.rad:1: the scene 'room.rad' includes itself"));
  write_text(beside("a.rad"), "\n!cat b.rad\n");
  write_text(beside("b.rad"), "!cat ./a.rad\n");
  EXPECT_THAT(refusal("!cat a.rad\n"), HasSubstr("b.rad:1: the scene './a.rad' includes itself"));
}

TEST_F(Radiance, TooMuchIsRefusedBeforeItFillsTheMemory) {
  write_text(beside("ball.rad"), "paint sphere s 0 0 4 0 0 0 1000\n");
  write_text(beside("balls.rad"), "!xform -a 1000 -t 1 0 0 ball.rad\n");
  EXPECT_THAT(refusal("!xform -a 1000 -t 1 0 0 balls.rad\n"), HasSubstr("over 5000000 polygons"));
  std::string materials;
  for (int i = 0; i < 200; ++i) materials += kWall;
  write_text(beside("walls.rad"), materials);
  EXPECT_THAT(refusal("!xform -a 199999 -t 1 0 0 walls.rad\n"), HasSubstr("over 10000000 primitives"));
  write_text(beside("nothing.rad"), "# nothing\n");
  write_text(beside("much.rad"), "!xform -a 2000 -t 1 0 0 nothing.rad\n");
  EXPECT_THAT(refusal("!xform -a 2000 -t 1 0 0 much.rad\n"), HasSubstr("includes over 200000 files"));
  EXPECT_THAT(refusal("!xform -n " + std::string(1001, 'n') + " much.rad\n"), HasSubstr("over 1000 characters"));
}

TEST_F(Radiance, FilesThatAreNotThereAreNamedWithTheLine) {
  EXPECT_THAT(refusal("\n!xform lost.rad\n"), HasSubstr("room.rad:2: there is no file 'lost.rad'"));
  EXPECT_THAT(refusal("!xform -f lost.txt a.rad\n"), HasSubstr("room.rad:1: there is no file 'lost.txt'"));
  EXPECT_THAT(refusal("!cat .\n"), HasSubstr("this is a folder"));
  EXPECT_THAT(refusal("!rm -rf /\n"), HasSubstr("room.rad:1: the command '!rm -rf /' is not run"));
  EXPECT_THAT(refusal(kWall), HasSubstr("there is no face in this model"));
}

TEST(RadianceValidation, TheOfficeInLondonIsReadWithItsDefects) {
  CLERESTORY_NEEDS_SHARED_DATA("office-london");
  const fs::path folder = test::shared_data_dir() / "office-london";
  const test::ScratchFolder scratch;
  std::string scene;
  for (const char* name : {"material_unnamed.rad", "london-office.rad", "CIE_cloudySky_sky_12_21@1200.sky"})
    scene += "!cat \"" + (folder / name).string() + "\"\n";
  write_text(scratch.path() / "all.rad", scene);
  const ModelFile file = read_radiance(scratch.path() / "all.rad");
  EXPECT_EQ(file.model.polygon_count(), 1023U);
  EXPECT_THAT(file.model.material_names,
              UnorderedElementsAre("Exterior_Window", "Exterior_Wall", "Exterior_Floor", "Exterior_Roof"));
  EXPECT_NEAR(file.materials[0].transmittance_normal.value_or(0.0), 0.600, 5e-4);
  EXPECT_THAT(file.notices, Contains(testing::AllOf(HasSubstr("wrong count of numbers"),
                                                    HasSubstr("the first is 'N-00_001-00_010-I-W-3_0'"),
                                                    HasSubstr("london-office.rad:377"))));
  EXPECT_THAT(file.notices, Contains(HasSubstr("make a sky")));
  EXPECT_THAT(file.notices, Contains(HasSubstr("Distant sources were left out, since the study gives sun and sky: 2")));

  std::size_t bridged = 0;
  for (const mesh::Defect& defect : mesh::clean(file.model, {}).report.defects)
    if (defect.kind == "bridged loops") bridged = defect.found;
  EXPECT_EQ(bridged, 89U);
}

TEST(RadianceValidation, FacadeAndFurnitureAreReadWhole) {
  CLERESTORY_NEEDS_SHARED_DATA("rad-facade-furniture");
  const fs::path folder = test::shared_data_dir() / "rad-facade-furniture";
  const test::ScratchFolder scratch;
  std::string scene;
  for (const char* name : {"material_furniture.rad", "facade.rad", "furniture.rad"})
    scene += "!xform \"" + (folder / name).string() + "\"\n";
  write_text(scratch.path() / "all.rad", scene);
  const ModelFile file = read_radiance(scratch.path() / "all.rad");
  EXPECT_EQ(file.model.polygon_count(), 6572U);
  EXPECT_THAT(file.model.part_names, ElementsAre("facade", "furniture"));
  EXPECT_THAT(file.model.material_names, ElementsAre("steel", "woodfurnish"));
  EXPECT_EQ(file.materials[1].specular, 0.2);
  EXPECT_THAT(file.notices, Contains(HasSubstr("No file of the scene defines these materials")));
}

TEST(RadianceValidation, RadiancesOwnScenesAreReadOrRefusedInOneLine) {
  CLERESTORY_NEEDS_SHARED_DATA("radiance-tests");
  const fs::path folder = test::shared_data_dir() / "radiance-tests";
  const auto count = [&](const char* name) { return read_radiance(folder / name).model.polygon_count(); };
  EXPECT_EQ(count("gen/markers.rad"), 21U);
  EXPECT_EQ(count("gen/ref/genbox.rad"), 26U);
  EXPECT_GT(count("cornell_box/cornell.rad"), 6U);
  EXPECT_GT(count("cornell_box/cornell_window.rad"), 10U);
  EXPECT_GT(count("gen/ref/genprism.rad"), 8U);
  EXPECT_GT(count("gen/ref/genrev.rad"), 100U);
  EXPECT_EQ(count("gen/ref/gensurf.rad"), 105U);
  EXPECT_GT(count("gen/ref/genworm.rad"), 100U);
  EXPECT_THAT(refusal_of([&] { count("gen/ref/replmarks.rad"); }),
              HasSubstr("replmarks.rad:2: there is no file 'dummy.rad'"));
  EXPECT_THAT(refusal_of([&] { count("gen/ref/NYC11-15-14-21.rad"); }), HasSubstr("there is no face in this model"));
}

}  // namespace
}  // namespace clerestory::io
