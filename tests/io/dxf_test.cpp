// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dxf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/io/refusal.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

/// A DXF out of words "code=value", a group each.
std::string groups(const std::string& words) {
  std::istringstream in(words);
  std::string text;
  for (std::string word; in >> word;) {
    const std::size_t at = word.find('=');
    text += "  " + word.substr(0, at) + "\n" + word.substr(at + 1) + "\n";
  }
  return text;
}

std::string section(const std::string& name, const std::string& words) {
  return "0=SECTION 2=" + name + " " + words + " 0=ENDSEC ";
}

const std::string kFace = " 10=0 20=0 30=0 11=1 21=0 31=0 12=1 22=1 32=0 13=0 23=1 33=0 ";

std::string drawing(const std::string& entities, const std::string& blocks = {}, const std::string& tables = {}) {
  return groups(section("TABLES", tables) + section("BLOCKS", blocks) + section("ENTITIES", entities) + "0=EOF");
}

std::string block(const std::string& name, const std::string& entities, const std::string& base = "10=0 20=0 30=0") {
  return "0=BLOCK 8=0 2=" + name + " 70=0 " + base + " " + entities + " 0=ENDBLK 8=0 ";
}

std::string vertex(const std::string& xyz, int flags = 192) {
  std::istringstream in(xyz);
  std::string x;
  std::string y;
  std::string z;
  in >> x >> y >> z;
  return "0=VERTEX 8=0 10=" + x + " 20=" + y + " 30=" + z + " 70=" + std::to_string(flags) + " ";
}

class Dxf : public testing::Test {
 protected:
  ModelFile read(const std::string& text) {
    test::write_text(path(), text);
    return read_dxf(path(), {.unit = LengthUnit::kMetre});
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { read(text); });
  }
  std::filesystem::path path() const { return scratch_.path() / "house.dxf"; }

 private:
  test::ScratchFolder scratch_;
};

std::vector<mesh::Point> points_of(const ModelFile& file, std::size_t polygon) {
  std::vector<mesh::Point> points;
  for (const std::uint32_t corner : file.model.loop(polygon)) points.push_back(file.model.vertices[corner]);
  return points;
}

testing::Matcher<mesh::Point> near(double x, double y, double z) {
  using testing::DoubleNear;
  return testing::AllOf(testing::Field(&mesh::Point::x, DoubleNear(x, 1e-12)),
                        testing::Field(&mesh::Point::y, DoubleNear(y, 1e-12)),
                        testing::Field(&mesh::Point::z, DoubleNear(z, 1e-12)));
}

TEST_F(Dxf, FacesAreReadInDoubleAndLayersNamePartAndMaterial) {
  const auto file =
      read(drawing("0=3DFACE 8=Wall 10=612345.123456 20=5412345.654321 30=0.1 11=1 21=0 31=0 12=1 22=1 32=0 13=1 "
                   "23=1 33=0 0=3DFACE 8=Floor" +
                   kFace + "0=3DFACE 8=WALL" + kFace));
  ASSERT_EQ(file.model.polygon_count(), 3U);
  EXPECT_EQ(points_of(file, 0)[0], (mesh::Point{612345.123456, 5412345.654321, 0.1}));
  EXPECT_EQ(file.model.loop(0).size(), 3U) << "a fourth corner on the third one makes a triangle";
  EXPECT_EQ(file.model.loop(1).size(), 4U);
  EXPECT_THAT(file.model.part_names, ElementsAre("Wall", "Floor"));
  EXPECT_THAT(file.model.material_names, ElementsAre("Wall", "Floor"));
  EXPECT_EQ(file.model.polygon_line[0], 18U);
}

TEST_F(Dxf, TheUnitIsThatOfTheHeader) {
  const auto unit = [this](const std::string& code) {
    test::write_text(path(), groups(section("HEADER", "9=$ACADVER 1=AC1015 9=$INSUNITS 70=" + code) +
                                    section("ENTITIES", "0=3DFACE 8=a" + kFace) + "0=EOF"));
    return read_dxf(path());
  };
  EXPECT_EQ(unit("1").unit, LengthUnit::kInch);
  EXPECT_EQ(unit("4").unit, LengthUnit::kMillimetre);
  EXPECT_EQ(unit("6").unit, LengthUnit::kMetre);
  EXPECT_THAT(unit("5").notices, Contains(HasSubstr("is cm, as $INSUNITS in line 12 of the drawing says")));
  EXPECT_THAT(unit("14").notices, Contains(HasSubstr("$INSUNITS 14) is none of m, cm, mm, in, ft")));
}

TEST_F(Dxf, PolyfaceMeshesHaveFacesOnLayersOfTheirOwn) {
  const auto file = read(drawing("0=POLYLINE 8=Stair 66=1 70=64 71=4 72=2 " + vertex("0 0 0") + vertex("1 0 0") +
                                 vertex("1 1 0") + vertex("0 1 2") +
                                 "0=VERTEX 8=Rail 10=0 20=0 30=0 70=128 71=1 72=2 73=3 74=-4 "
                                 "0=VERTEX 10=0 20=0 30=0 70=128 71=-1 72=3 73=4 0=SEQEND 0=3DFACE 8=a" +
                                 kFace));
  ASSERT_EQ(file.model.polygon_count(), 3U);
  EXPECT_THAT(points_of(file, 0), ElementsAre(near(0, 0, 0), near(1, 0, 0), near(1, 1, 0), near(0, 1, 2)));
  EXPECT_EQ(file.model.loop(1).size(), 3U);
  EXPECT_THAT(file.model.part_names, ElementsAre("Rail", "Stair", "a"));
}

TEST_F(Dxf, PolygonMeshesAreGridsThatMayBeClosed) {
  std::string entities = "0=POLYLINE 8=Dome 66=1 70=17 71=3 72=2 ";
  for (const char* p : {"0 0 0", "0 0 1", "1 0 0", "1 0 1", "0 1 0", "0 1 1"}) entities += vertex(p, 64);
  const auto file = read(drawing(entities + "0=SEQEND"));
  ASSERT_EQ(file.model.polygon_count(), 3U);
  EXPECT_THAT(points_of(file, 2), ElementsAre(near(0, 1, 0), near(0, 0, 0), near(0, 0, 1), near(0, 1, 1)));
}

TEST_F(Dxf, OfASmoothedPolygonMeshTheSurfaceIsReadAndNotItsControls) {
  std::string entities = "0=POLYLINE 8=Dome 66=1 70=20 71=4 72=4 73=2 74=2 75=6 " + vertex("9 9 9", 80);
  for (const char* p : {"0 0 0", "0 1 0", "1 0 0", "1 1 0"}) entities += vertex(p, 72);
  EXPECT_EQ(read(drawing(entities + "0=SEQEND")).model.polygon_count(), 1U);
}

TEST_F(Dxf, MeshesHaveFacesOfAnyCornersAndCreasesArePassedOver) {
  const auto file = read(drawing(
      "0=MESH 8=Rock 71=2 72=0 91=1 92=5 10=0 20=0 30=0 10=1 20=0 30=0 10=2 20=1 30=0 10=1 20=2 30=0 "
      "10=0 20=1 30=0 93=10 90=5 90=0 90=1 90=2 90=3 90=4 90=3 90=0 90=1 90=2 94=1 90=0 90=1 95=1 140=1.0 90=0"));
  ASSERT_EQ(file.model.polygon_count(), 2U);
  EXPECT_EQ(file.model.loop(0).size(), 5U);
  EXPECT_THAT(file.notices, Contains(HasSubstr("1 MESH entities are to be smoothed")));
}

TEST_F(Dxf, BlocksArePlacedTurnedScaledAndRepeated) {
  const auto file = read(drawing("0=INSERT 8=Chairs 2=CHAIR 10=10 20=0 30=1 41=2 42=3 43=1 50=90 70=2 44=5",
                                 block("chair", "0=3DFACE 8=0" + kFace + "0=3DFACE 8=Leg" + kFace, "10=1 20=0 30=0")));
  ASSERT_EQ(file.model.polygon_count(), 4U);
  EXPECT_THAT(points_of(file, 0), ElementsAre(near(10, -2, 1), near(10, 0, 1), near(7, 0, 1), near(7, -2, 1)));
  EXPECT_THAT(points_of(file, 2)[1], near(10, 5, 1)) << "columns run along the turned x";
  EXPECT_THAT(file.model.part_names, ElementsAre("Chairs", "Leg")) << "layer 0 takes that of the insert";
}

TEST_F(Dxf, BlocksMayHoldBlocksAndBeMirrored) {
  const auto file =
      read(drawing("0=INSERT 8=a 2=outer 10=0 20=0 30=0 41=-1",
                   block("inner", "0=3DFACE 8=0" + kFace) + block("outer", "0=INSERT 8=0 2=inner 10=3 20=0 30=0")));
  ASSERT_EQ(file.model.polygon_count(), 1U);
  EXPECT_THAT(points_of(file, 0), ElementsAre(near(-3, 1, 0), near(-4, 1, 0), near(-4, 0, 0), near(-3, 0, 0)))
      << "the winding is kept, so that outside stays outside";
}

TEST_F(Dxf, AnExtrusionTurnsTheAxesOfAnInsert) {
  // Extrusion along +x: x' = y, y' = z.
  const auto file =
      read(drawing("0=INSERT 8=a 2=b 10=2 20=3 30=4 210=1 220=0 230=0", block("b", "0=3DFACE 8=0" + kFace)));
  EXPECT_THAT(points_of(file, 0), ElementsAre(near(4, 2, 3), near(4, 3, 3), near(4, 3, 4), near(4, 2, 4)));
}

TEST_F(Dxf, HiddenThingsAndWhatIsNoFaceAreLeftOutAndNamed) {
  const auto file =
      read(drawing("0=3DFACE 8=seen" + kFace + "0=3DFACE 8=OFF" + kFace + "0=3DFACE 8=frozen" + kFace +
                       "0=LINE 8=seen 10=0 20=0 0=LINE 8=seen 10=0 20=0 0=3DSOLID 8=seen 1=x 0=3DFACE 67=1 8=seen" +
                       kFace + "0=3DFACE 60=1 8=seen" + kFace + "0=INSERT 2=nowhere 10=0 20=0",
                   {},
                   "0=TABLE 2=LAYER 0=LAYER 2=seen 70=0 62=7 0=LAYER 2=off 70=0 62=-7 0=LAYER 2=frozen 70=1 62=7 "
                   "0=ENDTAB"));
  EXPECT_EQ(file.model.polygon_count(), 1U);
  EXPECT_THAT(file.notices,
              Contains(HasSubstr("1 3DSOLID, 2 LINE, 1 entities of the paper space, 1 invisible entities")));
  EXPECT_THAT(file.notices, Contains(HasSubstr("off or frozen in the drawing: the layers 'frozen', 'off'")));
  EXPECT_THAT(file.notices, Contains(HasSubstr("does not define them: the blocks 'nowhere'")));
}

TEST_F(Dxf, NamesAreReadInAnyEncoding) {
  EXPECT_THAT(read(drawing("0=3DFACE 8=W\\U+00E4nde" + kFace + "0=3DFACE 8=T\xfcren" + kFace)).model.part_names,
              ElementsAre("Wände", "Türen"));
}

TEST_F(Dxf, ContentTellsADxf) {
  EXPECT_TRUE(is_dxf("  0\r\nSECTION\r\n  2\r\n"));
  EXPECT_TRUE(is_dxf("AutoCAD Binary DXF\r\n"));
  EXPECT_FALSE(is_dxf("0 1 2"));
}

TEST_F(Dxf, BrokenFilesAreRefusedWithTheirLine) {
  EXPECT_THAT(refusal(""), HasSubstr("house.dxf: the file ends without EOF"));
  EXPECT_THAT(refusal("AutoCAD Binary DXF\r\n\x1a"), HasSubstr("this DXF is binary; save it as a text (ASCII) DXF"));
  EXPECT_THAT(refusal("v 0 0 0\n1\n"), HasSubstr("house.dxf:1: 'v 0 0 0' stands where the code of a group should"));
  EXPECT_THAT(refusal("0\nSECTION\n2\n"), HasSubstr("house.dxf:3: the file ends between a code and its value"));
  EXPECT_THAT(refusal(groups("0=SECTION 2=ENTITIES 0=3DFACE 8=a" + kFace)), HasSubstr("the file ends without EOF"));
  EXPECT_THAT(refusal(groups("0=SECTION 2=ENTITIES 0=EOF")), HasSubstr("house.dxf:6: a section does not end"));
  EXPECT_THAT(refusal(groups("5=1 0=EOF")), HasSubstr("house.dxf:1: a DXF file begins with a group of code 0"));
  EXPECT_THAT(refusal(drawing("0=LINE 8=a")),
              HasSubstr("there is no face in this drawing, only 1 LINE; export solids"));
  EXPECT_THAT(refusal(groups("0=EOF")), HasSubstr("there is no face in this model"));
  EXPECT_THAT(refusal(groups("0=SECTION 2=ENTITIES 0=3DFACE 10=0 20=x 11=0 21=0 12=1 22=1 0=ENDSEC 0=EOF")),
              HasSubstr("house.dxf:10: 'x' is no finite number"));
  EXPECT_THAT(refusal(groups("0=SECTION 2=ENTITIES 0=3DFACE 10=0 20=0 11=0 0=ENDSEC 0=EOF")),
              HasSubstr("house.dxf:6: this 3DFACE has no group 21"));
}

TEST_F(Dxf, IndicesAndCountsThatDoNotFitAreRefused) {
  const std::string polyface = "0=POLYLINE 70=64 " + vertex("0 0 0") + vertex("1 0 0") + vertex("1 1 0");
  EXPECT_THAT(refusal(drawing(polyface + "0=VERTEX 70=128 71=1 72=2 73=4")), HasSubstr("vertex 4 does not exist"));
  EXPECT_THAT(refusal(drawing(polyface + "0=VERTEX 70=128 71=1 72=2 73=-9223372036854775808")),
              HasSubstr("does not exist: the polyface mesh has 3"));
  EXPECT_THAT(refusal(drawing("0=POLYLINE 70=16 71=30000 72=30000 " + vertex("0 0 0", 64))),
              HasSubstr("promises 30000 x 30000 vertices and has 1"));
  EXPECT_THAT(refusal(drawing("0=MESH 10=0 20=0 30=0 93=2 90=3 90=0")), HasSubstr("promises 3 corners and has 1"));
  EXPECT_THAT(refusal(drawing("0=MESH 10=0 20=0 30=0 93=4 90=3 90=0 90=0 90=1")), HasSubstr("vertex 1 does not exist"));
}

TEST_F(Dxf, BlocksThatHoldThemselvesOrMultiplyWithoutEndAreRefused) {
  const std::string insert = "0=INSERT 2=a 10=0 20=0 ";
  EXPECT_THAT(refusal(drawing(insert, block("a", "0=INSERT 2=b 10=0 20=0") + block("b", insert))),
              HasSubstr("the block 'a' holds itself"));
  EXPECT_THAT(refusal(drawing("0=INSERT 2=a 10=0 20=0 70=32767 71=32767", block("a", ""))),
              HasSubstr("come to over 5000000 faces or 1000000 inserts"));
  std::string chain;
  for (int i = 0; i < 100'000; ++i)
    chain += block("b" + std::to_string(i), "0=INSERT 2=b" + std::to_string(i + 1) + " 10=0 20=0");
  EXPECT_THAT(refusal(drawing("0=INSERT 2=b0 10=0 20=0", chain)), HasSubstr("blocks hold blocks over 100 deep"));
  // Points that belong to no face multiply as well.
  std::string points = "0=POLYLINE 70=64 ";
  for (int i = 0; i < 100; ++i) points += vertex(std::to_string(i) + " 0 0");
  EXPECT_THAT(refusal(drawing("0=INSERT 2=a 10=0 20=0 70=1000 71=1000", block("a", points + "0=SEQEND"))),
              HasSubstr("come to over"));
}

}  // namespace
}  // namespace clerestory::io
