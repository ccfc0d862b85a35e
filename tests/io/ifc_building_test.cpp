// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc_building.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/ifc_samples.h"
#include "tests/io/refusal.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::HasSubstr;

class IfcBuildings : public testing::Test {
 protected:
  IfcBuilding read(const std::string& entities, const std::string& schema = "IFC4") {
    return read_text(test::ifc_text(entities, schema));
  }
  IfcBuilding read_text(const std::string& text) {
    test::write_text(path(), text);
    return read_ifc_building(path());
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { read_text(text); });
  }
  std::filesystem::path path() const { return scratch_.path() / "house.ifc"; }

 private:
  test::ScratchFolder scratch_;
};

double floor_area(const IfcRoom& room) {
  double area = 0.0;
  for (const auto& [a, b, c] : room.body.triangles) {
    const mesh::Vector n =
        mesh::cross(room.body.points[b] - room.body.points[a], room.body.points[c] - room.body.points[a]);
    if (n.z < -0.999 * mesh::norm(n)) area -= 0.5 * n.z;
  }
  return area;
}

TEST_F(IfcBuildings, WallOpeningAndWindowAreRelated) {
  const auto building = read(test::kIfcFrame + test::kIfcWall);
  ASSERT_EQ(building.elements.size(), 3U);  // the site is one
  const IfcElement& wall = building.elements[1];
  EXPECT_EQ(wall.class_name, "Wall");
  EXPECT_EQ(wall.name, "South");
  EXPECT_EQ(wall.openings, std::vector<std::size_t>{0});
  ASSERT_EQ(wall.items.size(), 1U);
  EXPECT_NEAR(mesh::volume(wall.items[0].body), 3.6, 1e-9);
  EXPECT_EQ(building.elements[2].fills, std::optional<std::size_t>(0));
  EXPECT_DOUBLE_EQ(building.elements[2].height_m, 1.2);
}

TEST_F(IfcBuildings, LightFixturesAreKnownByTheirTypeAndPlace) {
  const auto building = read(test::kIfcFrame + test::kIfcWall + test::kIfcFixtures);
  ASSERT_EQ(building.fixtures.size(), 2U);
  EXPECT_EQ(building.fixtures[0].type, "Panel 600");
  EXPECT_EQ(building.fixtures[0].name, "L1");
  EXPECT_NEAR(building.fixtures[0].placement.origin.z, 2.8, 1e-12);
  EXPECT_EQ(building.fixtures[1].type, "Panel 600");
  EXPECT_NEAR(building.fixtures[1].placement.origin.x, 1.5, 1e-12);
  EXPECT_NEAR(building.fixtures[1].placement.x.y, 1.0, 1e-12);
}

TEST_F(IfcBuildings, SiteHasPlaceAndNorth) {
  const auto building = read(test::kIfcFrame + test::kIfcWall);
  EXPECT_NEAR(building.site.latitude_deg.value(), 48.135, 1e-12);
  EXPECT_NEAR(building.site.longitude_deg.value(), -11.5, 1e-12);
  EXPECT_NEAR(building.site.north_deg.value(), 30.0, 1e-9);
  EXPECT_DOUBLE_EQ(building.metres_per_unit, 0.001);
}

TEST_F(IfcBuildings, OtherSchemasAreRefusedWithTheirName) {
  EXPECT_THAT(refusal(test::ifc_text(test::kIfcFrame + test::kIfcWall, "IFC4X3_ADD2")),
              HasSubstr("the schema IFC4X3_ADD2 is not read; export the model as IFC4 or IFC2x3"));
  EXPECT_THAT(refusal(test::ifc_text("", "AUTOMOTIVE_DESIGN")),
              HasSubstr("the schema 'AUTOMOTIVE_DESIGN' is not read"));
  EXPECT_THAT(refusal("ISO-10303-21;\n"), HasSubstr("its header names no schema"));
}

TEST_F(IfcBuildings, FileWithoutABodyIsRefused) {
  EXPECT_THAT(refusal(test::ifc_text(test::kIfcFrame)), HasSubstr("no element of this model has a body"));
  EXPECT_THAT(refusal(test::ifc_text("")), HasSubstr("no element of this model has a body"));
}

TEST_F(IfcBuildings, StraySemicolonIsNotAnEmptySuccess) {
  std::string entities = test::kIfcFrame + test::kIfcWall;
  entities.insert(entities.find("#20="), ";\n");
  const std::string answer = refusal(test::ifc_text(entities));
  EXPECT_TRUE(answer == "accepted" || answer.find("cannot be read") != std::string::npos) << answer;
  if (answer == "accepted") {
    EXPECT_EQ(read(entities).elements.size(), 3U);
  }
}

TEST_F(IfcBuildings, CircleOfPlacementsEnds) {
  std::string entities = test::kIfcFrame + test::kIfcWall;
  entities.replace(entities.find("IFCLOCALPLACEMENT($,#3)"), 23, "IFCLOCALPLACEMENT(#31,#3)");
  EXPECT_EQ(read(entities).elements.size(), 3U);
}

TEST_F(IfcBuildings, HalfSpaceCutsOnTheSideThatItsFlagNames) {
  std::string entities = test::kIfcFrame + test::kIfcWall;
  entities.replace(entities.find("(#23)"), 5, "(#60)");
  entities +=
      "#60=IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#23,#61);\n#61=IFCHALFSPACESOLID(#62,.F.);\n"
      "#62=IFCPLANE(#63);\n#63=IFCAXIS2PLACEMENT3D(#64,$,$);\n#64=IFCCARTESIANPOINT((0.,0.,2500.));\n";
  EXPECT_NEAR(mesh::volume(read(entities).elements[1].items.at(0).body), 4.0 * 0.3 * 2.5, 1e-9);
  entities.replace(entities.find("(#62,.F.)"), 9, "(#62,.T.)");
  EXPECT_NEAR(mesh::volume(read(entities).elements[1].items.at(0).body), 4.0 * 0.3 * 0.5, 1e-9);
}

TEST_F(IfcBuildings, BoundedHalfSpaceCutsWithinItsBoundary) {
  std::string entities = test::kIfcFrame + test::kIfcWall;
  entities.replace(entities.find("(#23)"), 5, "(#60)");
  entities +=
      "#60=IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#23,#61);\n"
      "#61=IFCPOLYGONALBOUNDEDHALFSPACE(#62,.F.,#3,#65);\n"
      "#62=IFCPLANE(#63);\n#63=IFCAXIS2PLACEMENT3D(#64,$,$);\n#64=IFCCARTESIANPOINT((0.,0.,2500.));\n"
      "#65=IFCPOLYLINE((#66,#67,#68,#69,#66));\n#66=IFCCARTESIANPOINT((0.,-500.));\n"
      "#67=IFCCARTESIANPOINT((5000.,-500.));\n#68=IFCCARTESIANPOINT((5000.,500.));\n"
      "#69=IFCCARTESIANPOINT((0.,500.));\n";
  EXPECT_NEAR(mesh::volume(read(entities).elements[1].items.at(0).body), 0.3 * (4.0 * 3.0 - 2.0 * 0.5), 1e-9);
}

TEST_F(IfcBuildings, UnknownSolidIsToldAsLost) {
  std::string entities = test::kIfcFrame + test::kIfcWall;
  entities.replace(entities.find("(#23)"), 5, "(#23,#60)");
  entities += "#60=IFCADVANCEDBREP(#61);\n#61=IFCCLOSEDSHELL(());\n";
  EXPECT_THAT(read(entities).notices, testing::Contains(HasSubstr("1 of kind IfcAdvancedBrep could not be converted")));
}

TEST(IfcHouses, FzkRoomsHaveTheStatedFloorAreas) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc");
  const auto building = read_ifc_building(test::ifc_file("AC20-FZK-Haus.ifc"));
  EXPECT_EQ(building.schema, "IFC4");
  ASSERT_EQ(building.rooms.size(), 7U);
  double sum = 0.0;
  for (const IfcRoom& room : building.rooms) {
    EXPECT_NEAR(floor_area(room), room.floor_area_m2.value(), 1e-3 * *room.floor_area_m2) << room.name;
    sum += floor_area(room);
  }
  EXPECT_NEAR(sum, 208.546, 5e-4);
  EXPECT_NEAR(building.site.north_deg.value(), -50.0, 0.01);
}

TEST(IfcHouses, DuplexRoomsHaveTheStatedVolumesButForTheTwoOpenShells) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc");
  const auto building = read_ifc_building(test::ifc_file("duplex.ifc"));
  EXPECT_EQ(building.schema, "IFC2X3");
  ASSERT_EQ(building.rooms.size(), 21U);
  std::vector<std::string> others;
  for (const IfcRoom& room : building.rooms)
    if (std::abs(mesh::volume(room.body) / room.volume_m3.value() - 1.0) > 1e-3) others.push_back(room.name);
  EXPECT_THAT(others, testing::ElementsAre("A201 Hallway", "B201 Hallway"));
}

TEST(IfcHouses, UnitsOfMillimetresAndUnknownKindsOfElement) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc");
  EXPECT_DOUBLE_EQ(read_ifc_building(test::ifc_file("example.ifc")).metres_per_unit, 0.001);
  EXPECT_THAT(test::refusal_of([] { read_ifc_building(test::ifc_file("Sample_entities.ifc")); }),
              HasSubstr("2 of the 466 entities of the model cannot be read"));
}

}  // namespace
}  // namespace clerestory::io
