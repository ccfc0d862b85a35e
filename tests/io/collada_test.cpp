// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/collada.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/outcome.h"
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

/// A triangle, (0,0,0) (1,0,0) (0,1,2), of the material oak in the node desk.
std::string triangle(const std::string& asset, const std::string& transform = "",
                     const std::string& phong = "<diffuse><color>0.5 0.4 0.3 1</color></diffuse>") {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>)" +
         asset + R"(</asset>
<library_effects><effect id="fx"><profile_COMMON><technique sid="t"><phong>)" +
         phong + R"(</phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="oak"><instance_effect url="#fx"/></material></library_materials>
<library_geometries><geometry id="g" name="shape"><mesh>
<source id="p"><float_array id="pa" count="9"> 0 0 0 1 0 0 0 1 2 </float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles material="s" count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node id="n" name="desk">)" +
         transform + R"(<instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="s" target="#m"/></technique_common></bind_material></instance_geometry></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>
)";
}

constexpr const char* kMetresZUp = R"(<unit meter="1"/><up_axis>Z_UP</up_axis>)";

class Collada : public testing::Test {
 protected:
  ModelFile read(const std::string& text, const ModelFormat& format = {}) {
    write_text(path(), text);
    return read_collada(path(), format);
  }
  std::string refusal(const std::string& text) {
    return refusal_of([&] { read(text); });
  }
  fs::path path() const { return scratch_.path() / "room.dae"; }

 private:
  test::ScratchFolder scratch_;
};

void expect_near(const mesh::Point& p, const mesh::Point& q, double tolerance = 1e-9) {
  EXPECT_NEAR(p.x, q.x, tolerance);
  EXPECT_NEAR(p.y, q.y, tolerance);
  EXPECT_NEAR(p.z, q.z, tolerance);
}

TEST_F(Collada, UnitAndUpAxisAreThoseOfTheAsset) {
  const ModelFile metres = read(triangle(kMetresZUp));
  EXPECT_EQ(metres.model.vertices[2], (mesh::Point{0.0, 1.0, 2.0}));
  EXPECT_THAT(metres.notices, ElementsAre(HasSubstr("is m, as line 3 of the model says")));
  const ModelFile inches = read(triangle(R"(<unit name="inch" meter="0.0254"/><up_axis>Y_UP</up_axis>)"));
  EXPECT_EQ(inches.unit, LengthUnit::kInch);
  EXPECT_EQ(inches.up, UpAxis::kY);
  EXPECT_EQ(inches.model.vertices[2], (mesh::Point{0.0, -2 * 0.0254, 0.0254}));
}

TEST_F(Collada, XUpIsTurnedToZ) {
  const ModelFile file = read(triangle(R"(<unit meter="1"/><up_axis>X_UP</up_axis>)"));
  EXPECT_EQ(file.up, UpAxis::kZ);
  expect_near(file.model.vertices[1], {0.0, 0.0, 1.0});
  expect_near(file.model.vertices[2], {-1.0, -2.0, 0.0});
}

TEST_F(Collada, AnyOtherUnitIsAppliedAndSaid) {
  const ModelFile yards = read(triangle(R"(<unit meter="0.9144"/><up_axis>Z_UP</up_axis>)"));
  EXPECT_EQ(yards.unit, LengthUnit::kMetre);
  expect_near(yards.model.vertices[1], {0.9144, 0.0, 0.0});
  EXPECT_THAT(yards.notices, ElementsAre(HasSubstr("is m, with its own of 0.9144 m applied, as line 3")));
}

TEST_F(Collada, TheStudyKnowsBetter) {
  const ModelFile file = read(triangle(kMetresZUp), {.unit = LengthUnit::kMillimetre, .up = UpAxis::kY});
  expect_near(file.model.vertices[2], {0.0, -0.002, 0.001});
}

TEST_F(Collada, WithoutAUnitItIsGuessed) {
  EXPECT_THAT(read(triangle("<up_axis>Z_UP</up_axis>")).notices,
              ElementsAre(HasSubstr("taken as m from the model's size")));
}

TEST_F(Collada, NodesPlaceTheirMeshes) {
  const ModelFile file = read(triangle(kMetresZUp, "<translate>10 0 0</translate><rotate>0 0 1 90</rotate>"));
  expect_near(file.model.vertices[1], {10.0, 1.0, 0.0}, 1e-6);
  EXPECT_THAT(file.model.part_names, ElementsAre("desk"));
}

TEST_F(Collada, TheDiffuseColourIsTold) {
  const ModelFile file = read(triangle(kMetresZUp));
  ASSERT_EQ(file.materials.size(), 1U);
  EXPECT_EQ(file.materials[0].name, "oak");
  EXPECT_THAT(*file.materials[0].diffuse, ElementsAre(0.5, 0.4, 0.3));
  EXPECT_FALSE(file.materials[0].shines);
  EXPECT_TRUE(read(triangle(kMetresZUp, "", "<emission><color>1 1 1 1</color></emission>")).materials[0].shines);
}

TEST_F(Collada, TransparencyIsOpacityUnlessAllWouldBeClear) {
  const auto opacity = [&](const std::string& transparency) {
    return read(triangle(kMetresZUp, "",
                         "<diffuse><color>1 1 1 1</color></diffuse><transparent><color>1 1 1 1</color></transparent>"
                         "<transparency><float>" +
                             transparency + "</float></transparency>"))
        .materials[0]
        .opacity.value();
  };
  EXPECT_NEAR(opacity("0.25"), 0.25, 1e-6);
  EXPECT_NEAR(opacity("0"), 1.0, 1e-6);
  EXPECT_NEAR(opacity("1"), 1.0, 1e-6);
}

TEST_F(Collada, FacesWithoutAMaterialDoNotGetAnother) {
  std::string text = triangle(kMetresZUp);
  const std::size_t binding = text.find("<bind_material>");
  text.erase(binding, text.find("</instance_geometry>") - binding);
  const ModelFile file = read(text);
  EXPECT_THAT(file.model.material_names, ElementsAre("default"));
  EXPECT_FALSE(file.materials[0].diffuse.has_value());
  EXPECT_THAT(file.unused_materials, ElementsAre("oak"));
  EXPECT_THAT(file.notices, Contains(HasSubstr("No material specified for subgroup <s>")));
}

TEST_F(Collada, BadFilesAreRefusedWithTheirLine) {
  EXPECT_THAT(refusal(""), HasSubstr("room.dae: the file is empty"));
  EXPECT_THAT(refusal("<COLLADA>\n<asset>\n</COLLADA>"), HasSubstr("room.dae:3: this is no sound XML"));
  EXPECT_THAT(refusal(triangle(R"(<unit meter="-1"/>)")),
              HasSubstr("room.dae:3: the unit of '-1' metres is no length"));
  std::string text = triangle(kMetresZUp);
  text.replace(text.find("<p>0 1 2</p>"), 12, "<p>0 1 7</p>");
  EXPECT_THAT(refusal(text), HasSubstr("room.dae: "));
  text = triangle(kMetresZUp);
  text.replace(text.find("0 0 0 1 0 0"), 11, "0 x 0 1 0 0");
  EXPECT_THAT(refusal(text), HasSubstr("room.dae: "));
  text = triangle(kMetresZUp);
  text.replace(text.find("<p>0 1 2</p>"), 12, "<ph><p>0 1 2</p><h>0 1 2</h></ph>");
  EXPECT_THAT(refusal(text), HasSubstr("room.dae:11: this polygon has holes, which the importer cannot read"));
  EXPECT_THAT(refusal("<COLLADA version=\"1.4.1\"></COLLADA>"), HasSubstr("room.dae: "));
}

TEST_F(Collada, ADocumentIsKnownByItsRoot) {
  EXPECT_TRUE(is_collada("<?xml version=\"1.0\"?>\n<COLLADA xmlns="));
  EXPECT_FALSE(is_collada("<?xml version=\"1.0\"?>\n<sdf>"));
}

std::string outcome(const fs::path& file) {
  return test::outcome_of(file, [](const fs::path& f) { return read_collada(f); });
}

mesh::Vector size_of(const ModelFile& file) {
  mesh::Box box;
  for (const mesh::Point& p : file.model.vertices) box.add(p);
  return box.size();
}

TEST(ColladaCollection, GoodModelsAreReadWhole) {
  CLERESTORY_NEEDS_SHARED_DATA("cad-assimp");
  const fs::path folder = test::shared_data_dir() / "cad-assimp" / "Collada";
  const char* quads = "6 faces, 24 vertices, 1 parts, 1 materials";
  const char* triangles = "12 faces, 36 vertices, 1 parts, 1 materials";
  EXPECT_EQ(outcome(folder / "ConcavePolygon.dae"), "1 faces, 66 vertices, 1 parts, 1 materials");
  EXPECT_EQ(outcome(folder / "cube_UTF16LE.dae"), quads);
  EXPECT_EQ(outcome(folder / "cube_UTF8BOM.dae"), quads);
  EXPECT_EQ(outcome(folder / "cube_emptyTags.dae"), quads);
  EXPECT_EQ(outcome(folder / "cube_triangulate.dae"), triangles);
  EXPECT_EQ(outcome(folder / "cube_tristrips.dae"), triangles);
  EXPECT_EQ(outcome(folder / "library_animation_clips.dae"), "26 faces, 104 vertices, 1 parts, 1 materials");
  EXPECT_EQ(outcome(folder / "regr01.dae"), "172 faces, 516 vertices, 1 parts, 6 materials");
  for (const char* name : {"cameras.dae", "lights.dae"})
    EXPECT_THAT(outcome(folder / name), HasSubstr("there is no face in this model"));
  EXPECT_NEAR(size_of(read_collada(folder / "cube_UTF8BOM.dae")).z, 1.0, 1e-6);
}

TEST(ColladaCollection, AnExporterThatTurnsTransparencyRoundIsFoundOut) {
  CLERESTORY_NEEDS_SHARED_DATA("cad-assimp");
  const ModelFile file = read_collada(test::shared_data_dir() / "cad-assimp" / "Collada" / "regr01.dae");
  EXPECT_THAT(file.notices, Contains(HasSubstr("opacity was taken the other way round")));
  for (const SourceMaterial& material : file.materials)
    EXPECT_NEAR(material.opacity.value(), material.name == "Vindue" ? 0.6 : 1.0, 1e-6) << material.name;
}

TEST(ColladaCollection, TheSmallHouseHasTheSizeOfAHouse) {
  CLERESTORY_NEEDS_SHARED_DATA("collada-small-house");
  const fs::path folder = test::shared_data_dir() / "collada-small-house";
  const auto size = [&](const std::string& part, const std::string& file) {
    return size_of(read_collada(folder / part / "meshes" / file));
  };
  const mesh::Vector walls = size("HouseWallB_01", "aws_HouseWallB_01_visual.DAE");
  EXPECT_NEAR(walls.x, 19.0, 1e-3);
  EXPECT_NEAR(walls.y, 11.4, 1e-3);
  EXPECT_NEAR(walls.z, 3.0, 1e-3);
  EXPECT_NEAR(size("Door_01", "aws_Door_01_visual.DAE").z, 2.22, 0.01);
  EXPECT_NEAR(size("ChairD_01", "aws_ChairD_01_visual.DAE").z, 0.775, 0.001);
  EXPECT_NEAR(size("BalconyTable_01", "aws_BalconyTable_01_visual.DAE").z, 0.4, 0.001);
}

TEST(ColladaCollection, EveryFileOfTheSmallHouseIsRead) {
  CLERESTORY_NEEDS_SHARED_DATA("collada-small-house");
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(test::shared_data_dir() / "collada-small-house")) {
    if (entry.path().extension() != ".DAE") continue;
    EXPECT_EQ(refusal_of([&] { read_collada(entry.path()); }), "accepted");
    ++files;
  }
  EXPECT_EQ(files, 26U);
}

}  // namespace
}  // namespace clerestory::io
