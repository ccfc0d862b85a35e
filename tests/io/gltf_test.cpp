// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/gltf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/io/gltf_text.h"
#include "tests/io/outcome.h"
#include "tests/io/refusal.h"
#include "tests/support/places.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

namespace fs = std::filesystem;
using test::gltf_of_triangle;
using test::refusal_of;
using test::write_text;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kDesk = R"([{"mesh": 0, "name": "desk"}])";

class Gltf : public testing::Test {
 protected:
  ModelFile read(const std::string& text, const ModelFormat& format = {}) {
    write_text(path(), text);
    return read_gltf(path(), format);
  }
  SourceMaterial material(const std::string& json) { return read(gltf_of_triangle(kDesk, json)).materials.at(0); }
  std::string refusal(const std::string& text) {
    return refusal_of([&] { read(text); });
  }
  fs::path path() const { return scratch_.path() / "room.gltf"; }
  fs::path beside(const std::string& name) const { return scratch_.path() / name; }

 private:
  test::ScratchFolder scratch_;
};

void expect_near(const mesh::Point& p, const mesh::Point& q, double tolerance = 1e-9) {
  EXPECT_NEAR(p.x, q.x, tolerance);
  EXPECT_NEAR(p.y, q.y, tolerance);
  EXPECT_NEAR(p.z, q.z, tolerance);
}

TEST_F(Gltf, YUpAndMetresUnlessTheStudySaysOtherwise) {
  const ModelFile file = read(gltf_of_triangle());
  ASSERT_EQ(file.model.polygon_count(), 1U);
  EXPECT_EQ(file.up, UpAxis::kY);
  EXPECT_EQ(file.unit, LengthUnit::kMetre);
  EXPECT_THAT(file.notices, Contains(HasSubstr("is m, as glTF prescribes")));
  expect_near(file.model.vertices[2], {0.0, 0.0, 1.0});
  const ModelFile other = read(gltf_of_triangle(), {.unit = LengthUnit::kMillimetre, .up = UpAxis::kZ});
  expect_near(other.model.vertices[2], {0.0, 0.001, 0.0});
}

TEST_F(Gltf, NodesPlaceTheirMeshesInDouble) {
  const ModelFile file = read(gltf_of_triangle(
      R"([{"children": [1], "translation": [1000, 0, 0]},
          {"mesh": 0, "name": "desk", "translation": [0, 0, 0.5], "scale": [2, 2, 2], "rotation": [0, 0, 0.70710678, 0.70710678]}])"));
  ASSERT_EQ(file.model.vertices.size(), 3U);
  expect_near(file.model.vertices[0], {1000.0, -0.5, 0.0});
  expect_near(file.model.vertices[1], {1000.0, -0.5, 2.0}, 1e-6);
  expect_near(file.model.vertices[2], {998.0, -0.5, 0.0}, 1e-6);
}

TEST_F(Gltf, AMeshThatStandsTwiceIsThereTwice) {
  const ModelFile file = read(gltf_of_triangle(
      R"([{"children": [1, 2]}, {"mesh": 0, "name": "left"}, {"mesh": 0, "name": "right", "translation": [5, 0, 0]}])"));
  EXPECT_EQ(file.model.polygon_count(), 2U);
  EXPECT_THAT(file.model.part_names, ElementsAre("left", "right"));
}

TEST_F(Gltf, ANodeThatMirrorsKeepsTheFrontSideInFront) {
  const ModelFile file = read(gltf_of_triangle(R"([{"mesh": 0, "scale": [-1, 1, 1]}])"));
  const auto loop = file.model.loop(0);
  const auto& v = file.model.vertices;
  const mesh::Vector normal = cross(v[loop[1]] - v[loop[0]], v[loop[2]] - v[loop[0]]);
  expect_near(mesh::Point{} + normal, {0.0, -1.0, 0.0});  // z of the glTF, as before
}

TEST_F(Gltf, PartsAndMaterialsKeepTheirNames) {
  const ModelFile file = read(gltf_of_triangle());
  EXPECT_THAT(file.model.part_names, ElementsAre("desk"));
  EXPECT_THAT(file.model.material_names, ElementsAre("oak"));
  EXPECT_THAT(read(gltf_of_triangle(R"([{"mesh": 0}])")).model.part_names, ElementsAre("default"));
  EXPECT_TRUE(file.unused_materials.empty());
}

TEST_F(Gltf, TheBaseColourIsLinearAndLosesItsMetallicShare) {
  const SourceMaterial wood = material(
      R"({"name": "oak", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.4, 0.3, 1], "metallicFactor": 0}})");
  ASSERT_TRUE(wood.diffuse.has_value());
  EXPECT_THAT(*wood.diffuse, ElementsAre(0.5, 0.4, 0.3));
  EXPECT_FALSE(wood.specular.has_value());
  EXPECT_FALSE(wood.opacity.has_value());
  EXPECT_FALSE(wood.shines);
  const SourceMaterial metal = material(
      R"({"name": "steel", "pbrMetallicRoughness": {"baseColorFactor": [0.6, 0.6, 0.6, 1], "metallicFactor": 0.5}})");
  EXPECT_NEAR(metal.diffuse->at(1), 0.3, 1e-12);
  EXPECT_NEAR(metal.specular.value(), 0.3, 1e-12);
}

TEST_F(Gltf, AMaterialThatSaysNothingTellsNothing) {
  EXPECT_FALSE(material(R"({"name": "oak"})").diffuse.has_value());
  EXPECT_FALSE(material(R"({"name": "oak"})").specular.has_value());
}

TEST_F(Gltf, AlphaIsOpacityOnlyWhereItBlends) {
  const auto with_mode = [&](const std::string& mode) {
    return material(R"({"name": "a", "alphaMode": ")" + mode +
                    R"(", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25], "metallicFactor": 0}})");
  };
  EXPECT_EQ(with_mode("BLEND").opacity, 0.25);
  EXPECT_FALSE(with_mode("OPAQUE").opacity.has_value());
  EXPECT_FALSE(with_mode("MASK").opacity.has_value());
}

TEST_F(Gltf, TransmissionIsTransmittanceLessTheReflectionOfADielectric) {
  const SourceMaterial glass = material(
      R"({"name": "a", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.5}},
          "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0}})");
  EXPECT_NEAR(glass.transmittance_normal.value(), 0.5 * 0.96 * 0.8, 1e-6);
  EXPECT_NEAR(glass.diffuse->at(0), 0.4, 1e-6);
}

TEST_F(Gltf, EmissionShinesWithoutAPhotometricMeaning) {
  EXPECT_TRUE(material(R"({"name": "lamp", "emissiveFactor": [0, 0.5, 0]})").shines);
}

TEST_F(Gltf, CoordinatesThatAreCoarseAreSaid) {
  const std::array<float, 9> far{612345.0F, 0, 0, 612346.0F, 0, 0, 612345.0F, 1, 0};
  EXPECT_THAT(read(gltf_of_triangle(kDesk, R"({"name": "oak"})", far)).notices,
              Contains(HasSubstr("single precision, which is 62 mm coarse")));
  EXPECT_THAT(read(gltf_of_triangle(R"([{"mesh": 0, "translation": [0, 0, 20000]}])")).notices,
              Contains(HasSubstr("which is 2 mm coarse")));
  const std::array<float, 9> near{8000.0F, 0, 0, 8001.0F, 0, 0, 8000.0F, 1, 0};
  EXPECT_THAT(read(gltf_of_triangle(kDesk, R"({"name": "oak"})", near)).notices,
              testing::Not(Contains(HasSubstr("coarse"))));
}

TEST_F(Gltf, BadFilesAreRefusedInOneLineWithTheFile) {
  EXPECT_THAT(refusal(""), HasSubstr("room.gltf:1: the file stops being JSON here"));
  EXPECT_THAT(refusal("{\"asset\":\n{\"version\": \"2.0\"},\n oops}"),
              HasSubstr("room.gltf:3: the file stops being JSON here"));
  EXPECT_THAT(refusal("glTF\2\0\0\0"), HasSubstr("room.gltf: "));
  const std::array<float, 9> nan{std::nanf(""), 0, 0, 1, 0, 0, 0, 1, 0};
  EXPECT_THAT(refusal(gltf_of_triangle(kDesk, "{}", nan)), HasSubstr("room.gltf: a vertex has a coordinate"));
  EXPECT_THAT(refusal_of([&] { read_gltf(beside("none.glb")); }), HasSubstr("none.glb: there is no such model"));
  EXPECT_THAT(refusal_of([&] { read_gltf(beside("")); }), HasSubstr("this is a folder"));
}

TEST_F(Gltf, ABufferThatIsNotThereIsNamed) {
  std::string text = gltf_of_triangle();
  const std::size_t begin = text.find("data:");
  text.replace(begin, text.find('"', begin) - begin, "room.bin");
  EXPECT_THAT(refusal(text),
              HasSubstr("room.gltf: there is no file 'room.bin', which it names; put it beside the model"));
  text.replace(text.find("room.bin"), 8, "/dev/zero");
  EXPECT_THAT(refusal(text), HasSubstr("there is no file 'zero', which it names"));
}

TEST_F(Gltf, AGlbIsKnownByItsFirstBytes) {
  EXPECT_TRUE(is_glb("glTF\2"));
  EXPECT_FALSE(is_glb("{\"asset\""));
}

std::string outcome(const fs::path& file) {
  return test::outcome_of(file, [](const fs::path& f) { return read_gltf(f); });
}

TEST(GltfCollection, GoodModelsAreReadWhole) {
  CLERESTORY_NEEDS_SHARED_DATA("cad-assimp");
  const fs::path folder = test::shared_data_dir() / "cad-assimp" / "glTF2";
  const char* box = "12 faces, 24 vertices, 1 parts, 1 materials";
  EXPECT_EQ(outcome(folder / "BoxTextured-glTF" / "BoxTextured.gltf"), box);
  EXPECT_EQ(outcome(folder / "BoxTextured-glTF-Embedded" / "BoxTextured.gltf"), box);
  EXPECT_EQ(outcome(folder / "cameras" / "Cameras.gltf"), "2 faces, 4 vertices, 1 parts, 1 materials");
  EXPECT_EQ(outcome(folder / "IncorrectVertexArrays" / "Cube.gltf"), "46 faces, 138 vertices, 4 parts, 1 materials");
  const ModelFile cut = read_gltf(folder / "IncorrectVertexArrays" / "Cube.gltf");
  EXPECT_THAT(cut.notices, Contains(HasSubstr("not compatible with the TRIANGLES mode. Some vertices were dropped")));
  EXPECT_THAT(cut.notices, Contains(HasSubstr("70 lines and points of the model were passed over")));
  const ModelFile textured = read_gltf(folder / "BoxTextured-glTF" / "BoxTextured.gltf");
  EXPECT_TRUE(textured.materials[0].textured);
  ASSERT_EQ(textured.files.size(), 2U);
  EXPECT_EQ(textured.files[1].filename(), "BoxTextured0.bin");
}

TEST(GltfCollection, TheEightModesOfPrimitivesAreTrianglesOrPassedOver) {
  CLERESTORY_NEEDS_SHARED_DATA("cad-assimp");
  const fs::path folder =
      test::shared_data_dir() / "cad-assimp" / "glTF2" / "glTF-Asset-Generator" / "Mesh_PrimitiveMode";
  for (int which = 0; which < 16; ++which) {
    const std::string name =
        "Mesh_PrimitiveMode_" + std::string(which < 10 ? "0" : "") + std::to_string(which) + ".gltf";
    const bool is_lines = which < 4 || (which >= 7 && which <= 10);
    EXPECT_THAT(outcome(folder / name), HasSubstr(is_lines ? "there is no face in this model" : "2 faces, ")) << name;
  }
}

TEST(GltfCollection, MalformedModelsAreRefusedInOneLine) {
  CLERESTORY_NEEDS_SHARED_DATA("cad-assimp");
  const fs::path folder = test::shared_data_dir() / "cad-assimp" / "glTF2";
  EXPECT_THAT(outcome(folder / "MissingBin" / "BoxTextured.gltf"),
              HasSubstr("BoxTextured.gltf: there is no file 'BoxTextured0.bin', which it names"));
  EXPECT_THAT(outcome(folder / "IndexOutOfRange" / "IndexOutOfRange.gltf"),
              HasSubstr("a face has a corner that does not exist"));
  EXPECT_THAT(outcome(folder / "IndexOutOfRange" / "AllIndicesOutOfRange.gltf"),
              HasSubstr("a face has a corner that does not exist"));
  EXPECT_THAT(outcome(folder / "RecursiveNodes" / "RecursiveNodes.gltf"), HasSubstr("recursive reference"));
  EXPECT_THAT(outcome(folder / "SchemaFailures" / "sceneWrongType.gltf"), HasSubstr("\"scene\" was not of type"));
  EXPECT_THAT(outcome(folder / "TestNoRootNode" / "NoScene.gltf"), HasSubstr("No scene"));
  EXPECT_THAT(outcome(folder / "TestNoRootNode" / "SceneWithoutNodes.gltf"), HasSubstr("there is no face"));
  for (const char* name : {"badArray", "badExtension", "badNumber", "badObject", "badString", "badUint"}) {
    const std::string text = outcome(folder / "wrongTypes" / (std::string(name) + ".gltf"));
    EXPECT_THAT(text, HasSubstr("was not of type")) << name;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace clerestory::io
