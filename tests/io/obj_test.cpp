// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/obj.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "tests/io/refusal.h"
#include "tests/support/places.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

namespace fs = std::filesystem;
using test::refusal_of;
using test::write_text;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 2\n";

class Obj : public testing::Test {
 protected:
  ModelFile read(const std::string& text, const ModelFormat& format = {}) {
    write_text(path(), text);
    return read_obj(path(), format);
  }
  std::string refusal(const std::string& text) {
    return refusal_of([&] { read(text); });
  }
  fs::path path() const { return scratch_.path() / "room.obj"; }
  fs::path beside(const std::string& name) const { return scratch_.path() / name; }

 private:
  test::ScratchFolder scratch_;
};

TEST_F(Obj, LargeCoordinatesComeBackAsTheNearestDouble) {
  const auto file = read("v 612345.123456 5412345.654321 0.1\nv 1e0 +2.5E-1 -.5\nv 3 4 5\nf 1 2 3\n");
  EXPECT_EQ(file.model.vertices[0], (mesh::Point{612345.123456, 5412345.654321, 0.1}));
  EXPECT_EQ(file.model.vertices[1], (mesh::Point{1.0, 0.25, -0.5}));
}

TEST_F(Obj, TheLatestObjectOrGroupNamesThePart) {
  const auto file = read(std::string(kTriangle) + "f 1 2 3\no desk\nf 1 2 3\ng legs of desk\nf 1 2 3\ng\nf 1 2 3\n");
  EXPECT_THAT(file.model.part_names, ElementsAre("default", "desk", "legs of desk"));
  EXPECT_EQ(file.model.polygon_part[3], mesh::PartId(1U));
}

TEST_F(Obj, MaterialsAreNamedByUsemtlWithSpacesAndWithoutMtl) {
  const auto file = read(std::string(kTriangle) + "f 1 2 3\nusemtl oak,  white  \nf 1 2 3\n");
  EXPECT_THAT(file.model.material_names, ElementsAre("default", "oak,  white"));
  ASSERT_EQ(file.materials.size(), 2U);
  EXPECT_FALSE(file.materials[1].diffuse.has_value());
}

TEST_F(Obj, FacesKeepAllTheirCornersAndTheirLine) {
  const auto file = read("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\n\nf 1/1/1 2//2 3/3 4 -1\n");
  ASSERT_EQ(file.model.polygon_count(), 1U);
  EXPECT_THAT(file.model.loop(0), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(file.model.polygon_line[0], 7U);
}

TEST_F(Obj, NegativeNumbersCountBackFromTheFace) {
  const auto file = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 -2 -3\n");
  EXPECT_EQ(file.model.vertices[file.model.loop(1)[0]], (mesh::Point{5.0, 5.0, 5.0}));
}

TEST_F(Obj, FacesMayStandBeforeTheirVertices) {
  EXPECT_EQ(read("f 1 2 3\n" + std::string(kTriangle)).model.polygon_count(), 1U);
}

TEST_F(Obj, ReadsAnyEndOfLineByteOrderMarksAndContinuedLines) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text = "\xef\xbb\xbfv 0 0 0|v 1 0 \\|0|v 0 1 0|f 1 2 \\|3";
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos;) text.replace(at, 1, end);
    const auto file = read(text);
    EXPECT_EQ(file.model.vertices.size(), 3U);
    EXPECT_EQ(file.model.polygon_line[0], 5U);
  }
}

TEST_F(Obj, PointsLinesAndUnusedVerticesAreLeftOut) {
  const auto file = read("v 99 99 99\nv 0 0 0\nv 1 0 0\nv 0 1 0\np 1\nl 1 2\nvt 0 0\nvn 0 0 1\ns off\nf 2 3 4\n");
  EXPECT_EQ(file.model.vertices.size(), 3U);
  EXPECT_EQ(file.model.polygon_count(), 1U);
}

TEST_F(Obj, YUpBecomesZUpAndKeepsItsHandedness) {
  const auto file = read("v 1 2 3\nv 0 0 0\nv 1 0 0\nf 1 2 3\n", {.unit = LengthUnit::kMillimetre, .up = UpAxis::kY});
  EXPECT_EQ(file.model.vertices[0], (mesh::Point{0.001, -0.003, 0.002}));
}

TEST_F(Obj, TheUnitIsThatOfTheStudyElseOfTheHeaderElseGuessed) {
  const std::string body = "v 0 0 0\nv 6000 0 0\nv 0 8000 2700\nf 1 2 3\n";
  EXPECT_EQ(read(body).unit, LengthUnit::kMillimetre);
  EXPECT_THAT(read(body).notices, ElementsAre(HasSubstr("taken as mm from the model's size: 6 x 8 x 2.7 m")));
  EXPECT_EQ(read("# File units = inches\n" + body).unit, LengthUnit::kInch);
  EXPECT_THAT(read("# File units = inches\n" + body).notices,
              ElementsAre(HasSubstr("is in, as line 1 of the model says")));
  const auto given = read("# File units = inches\n" + body, {.unit = LengthUnit::kFoot});
  EXPECT_EQ(given.unit, LengthUnit::kFoot);
  EXPECT_TRUE(given.notices.empty());
}

TEST_F(Obj, LinesThatItDoesNotKnowAreReported) {
  EXPECT_THAT(read(std::string(kTriangle) + "f 1 2 3\nfrobnicate 1\n").notices,
              testing::Contains(HasSubstr(
                  "1 lines of the model were not understood and passed over, the first is 'frobnicate' in line 5")));
}

TEST_F(Obj, MtlGivesMaterialsInTheOrderOfTheModel) {
  write_text(beside("my colours.mtl"), "newmtl red\nKd 0.6 0.1 0.1\nnewmtl spare\nnewmtl clear\nKd 1\nd 0.2\n");
  const auto file = read("mtllib my colours.mtl\n" + std::string(kTriangle) +
                         "usemtl clear\nf 1 2 3\nusemtl red\nf 1 2 3\nusemtl other\nf 1 2 3\n");
  ASSERT_EQ(file.materials.size(), 3U);
  EXPECT_EQ(file.materials[0].opacity, 0.2);
  EXPECT_THAT(*file.materials[1].diffuse, ElementsAre(0.6, 0.1, 0.1));
  EXPECT_FALSE(file.materials[2].diffuse.has_value());
  EXPECT_THAT(file.unused_materials, ElementsAre("spare"));
  EXPECT_EQ(file.files.size(), 2U);
}

TEST_F(Obj, AnMtlPathOfAnotherMachineIsFoundBesideTheModel) {
  write_text(beside("room.mtl"), "newmtl red\nKd 0.6 0.1 0.1\n");
  EXPECT_EQ(read("mtllib C:\\Users\\eva\\room.mtl\n" + std::string(kTriangle) + "f 1 2 3\n").unused_materials.size(),
            1U);
}

TEST_F(Obj, AnMtlMayLieInAFolderAndHaveBlanksInItsName) {
  fs::create_directory(beside("my materials"));
  write_text(beside("my materials") / "of the room.mtl", "newmtl red\n");
  for (const char* name : {"my materials/of the room.mtl", "./my materials\\of the room.mtl"})
    EXPECT_EQ(read("mtllib " + std::string(name) + "\n" + kTriangle + "f 1 2 3\n").files.size(), 2U) << name;
}

TEST_F(Obj, TheMtlOfAModelThatWasRenamedWithItStandsInForTheOneNamed) {
  write_text(beside("room.mtl"), "newmtl red\n");
  const auto file = read("mtllib old.mtl\n" + std::string(kTriangle) + "f 1 2 3\n");
  EXPECT_THAT(file.unused_materials, ElementsAre("red"));
  EXPECT_THAT(file.notices,
              testing::Contains(HasSubstr("there is no MTL file 'old.mtl'; 'room.mtl' was read instead")));
}

TEST_F(Obj, OfSeveralMtlFilesThoseThatAreThereAreReadAndTheOthersReported) {
  write_text(beside("b.mtl"), "newmtl red\n");
  const auto file = read("mtllib a.mtl b.mtl\n" + std::string(kTriangle) + "f 1 2 3\n");
  EXPECT_THAT(file.notices, testing::Contains(HasSubstr("there is no MTL file 'a.mtl'")));
}

TEST_F(Obj, AMissingMtlIsNamedWithItsLineAndARemedy) {
  const std::string text = refusal("# room\nmtllib lost.mtl\n" + std::string(kTriangle) + "f 1 2 3\n");
  EXPECT_THAT(text, HasSubstr("room.obj:2: there is no MTL file 'lost.mtl'; put it beside the model"));
}

TEST_F(Obj, BadFacesAreRefusedWithTheirLine) {
  const std::string vertices(kTriangle);
  EXPECT_THAT(refusal(vertices + "f 1 2 3\nf 1 2 4\n"),
              HasSubstr("room.obj:5: vertex 4 does not exist: the model has 3"));
  EXPECT_THAT(refusal(vertices + "f -4 2 3\n"), HasSubstr("room.obj:4: vertex -4 does not exist"));
  EXPECT_THAT(refusal(vertices + "f 0 2 3\n"), HasSubstr("room.obj:4: the vertex number 0"));
  EXPECT_THAT(refusal(vertices + "f 1 2\n"), HasSubstr("room.obj:4: a face has at least 3 corners, this one has 2"));
  EXPECT_THAT(refusal(vertices + "f\n"), HasSubstr("this one has 0"));
  EXPECT_THAT(refusal(vertices + "f 1 2 x\n"), HasSubstr("'x' is no corner of a face"));
  EXPECT_THAT(refusal(vertices + "f 1 2 1.5\n"), HasSubstr("'1.5' is no corner of a face"));
  EXPECT_THAT(refusal(vertices + "f 1 2 99999999999999999999\n"), HasSubstr("is no corner of a face"));
  EXPECT_THAT(refusal(vertices + "f 1 2 5000000000\n"), HasSubstr("vertex 5000000000 does not exist"));
}

TEST_F(Obj, BadCoordinatesAreRefusedWithTheirLine) {
  for (const char* bad : {"nan", "inf", "-inf", "1e400", "1,5", "0x10", "3.1+e2", "--1", "+-1", "1e"})
    EXPECT_THAT(refusal("v 0 0 0\nv 0 " + std::string(bad) + " 0\n"),
                HasSubstr("room.obj:2: the coordinate '" + std::string(bad) + "' is no finite number"));
  EXPECT_THAT(refusal("v 0 0 1e30\n"), HasSubstr("beyond any building"));
  EXPECT_THAT(refusal("v 0 0\n"), HasSubstr("room.obj:1: a vertex has three coordinates, this line has 2"));
}

TEST_F(Obj, FilesThatAreNoModelAreRefused) {
  EXPECT_THAT(refusal(""), HasSubstr("room.obj: there is no face in this model"));
  EXPECT_THAT(refusal("v 0 0 0\n"), HasSubstr("there is no face in this model"));
  EXPECT_THAT(refusal(std::string("v 0 0 0\nv\0", 10)), HasSubstr("room.obj:2: there is a zero byte here"));
  EXPECT_THAT(refusal_of([&] { read_obj(beside("none.obj")); }), HasSubstr("none.obj: there is no such model"));
  EXPECT_THAT(refusal_of([&] { read_obj(beside("")); }), HasSubstr("this is a folder"));
  EXPECT_THAT(refusal_of([] { read_obj("/dev/zero"); }), HasSubstr("this is no regular file"));
}

TEST_F(Obj, AnEndlessLineIsRefusedBeforeItFillsTheMemory) {
  write_text(path(), "v 0 0 0\nf ");
  fs::resize_file(path(), std::uintmax_t{2} << 30);  // sparse: zero bytes
  EXPECT_THAT(refusal_of([&] { read_obj(path()); }), HasSubstr("room.obj:2: there is a zero byte here"));
  write_text(path(), "v 0 0 0\nf " + std::string(std::size_t{65} << 20, '1'));
  EXPECT_THAT(refusal_of([&] { read_obj(path()); }), HasSubstr("room.obj:2: this line has over 64 MiB"));
}

TEST_F(Obj, MessagesAreOfOneLineWhateverTheFileSays) {
  const std::string text = refusal("v 0 0 \x1b[31m\x07" + std::string(500, 'x') + "\n");
  EXPECT_LT(text.size(), 400U);
  EXPECT_EQ(text.find_first_of("\n\r\x1b\x07"), std::string::npos);
}

/// "16784 faces, 10722 vertices, 13 materials" or the refusal without its folder.
std::string outcome(const fs::path& file) {
  const std::string refusal = refusal_of([&] { read_obj(file); });
  if (refusal != "accepted") return refusal.substr(file.parent_path().string().size() + 1);
  const auto model = read_obj(file).model;
  return std::to_string(model.polygon_count()) + " faces, " + std::to_string(model.vertices.size()) + " vertices, " +
         std::to_string(model.material_names.size()) + " materials";
}

TEST(ObjValidation, TheReferenceScenesAreReadWhole) {
  CLERESTORY_NEEDS_VALIDATION("office");
  const fs::path folder = test::validation_dir();
  EXPECT_EQ(outcome(folder / "office" / "scene.obj"), "288 faces, 212 vertices, 10 materials");
  EXPECT_EQ(outcome(folder / "lamp-room" / "scene.obj"), "20 faces, 16 vertices, 2 materials");
  EXPECT_EQ(outcome(folder / "atrium" / "scene.obj"), "16784 faces, 10722 vertices, 13 materials");
}

TEST(ObjValidation, RealModelsAreReadWhole) {
  CLERESTORY_NEEDS_SHARED_DATA("cad-assimp");
  const fs::path folder = test::shared_data_dir();
  EXPECT_EQ(outcome(folder / "office-london" / "derived_london-office.obj"), "1023 faces, 1060 vertices, 4 materials");
  EXPECT_EQ(outcome(folder / "cornell-box" / "cornell_box.obj"), "17 faces, 68 vertices, 3 materials");
  EXPECT_EQ(outcome(folder / "cad-assimp" / "OBJ" / "concave_polygon.obj"), "1 faces, 64 vertices, 1 materials");
  EXPECT_EQ(outcome(folder / "cad-assimp" / "OBJ" / "box_mat_with_spaces.obj"), "6 faces, 8 vertices, 1 materials");
  EXPECT_EQ(outcome(folder / "cad-tinyobj" / "mtl filename with whitespace issue46.obj"),
            "6 faces, 8 vertices, 1 materials");
}

}  // namespace
}  // namespace clerestory::io
