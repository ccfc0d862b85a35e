// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ifc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include "mesh/clean.h"
#include "tests/io/ifc_samples.h"
#include "tests/io/refusal.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

class Ifc : public testing::Test {
 protected:
  ModelFile read(const std::string& text, const ModelFormat& format = {}) {
    test::write_text(path(), text);
    return read_model(path(), format);
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { read(text); });
  }
  std::filesystem::path path() const { return scratch_.path() / "house.ifc"; }

 private:
  test::ScratchFolder scratch_;
};

mesh::Box box_of(const mesh::Model& model) {
  mesh::Box box;
  for (const mesh::Point& p : model.vertices) box.add(p);
  return box;
}

double area_of(const mesh::Model& model, std::size_t polygon) {
  mesh::Vector sum;
  for (std::size_t which = 0; which < model.loop_count(polygon); ++which) {
    const auto loop = model.loop(polygon, which);
    const mesh::Point& origin = model.vertices[model.loop(polygon)[0]];
    for (std::size_t i = 0; i < loop.size(); ++i)
      sum = sum + mesh::cross(model.vertices[loop[i]] - origin, model.vertices[loop[(i + 1) % loop.size()]] - origin);
  }
  return 0.5 * mesh::norm(sum);
}

TEST_F(Ifc, IsToldByItsContentAndComesInMetres) {
  const auto file = read(test::ifc_text(test::kIfcFrame + test::kIfcWall));
  EXPECT_EQ(file.format, "IFC4");
  EXPECT_EQ(file.unit, LengthUnit::kMillimetre);
  EXPECT_NEAR(box_of(file.model).size().z, 3.0, 1e-9);
  EXPECT_THAT(file.model.part_names, testing::ElementsAre("Wall South", "Window W"));
  EXPECT_NEAR(file.site.north_deg.value(), 30.0, 1e-9);
}

TEST_F(Ifc, UnitOfTheUserCountsInsteadOfTheFiles) {
  const auto file = read(test::ifc_text(test::kIfcFrame + test::kIfcWall), {LengthUnit::kCentimetre, {}});
  EXPECT_EQ(file.unit, LengthUnit::kCentimetre);
  EXPECT_NEAR(box_of(file.model).size().z, 30.0, 1e-9);
}

TEST_F(Ifc, OuterFacesShowTheOuterLayers) {
  const auto file = read(test::ifc_text(
      test::kIfcFrame + test::kIfcWall +
      "#70=IFCRELASSOCIATESMATERIAL('1kTvXnbbzCWw8lcMd1dR4v',$,$,$,(#20),#71);\n"
      "#71=IFCMATERIALLAYERSETUSAGE(#72,.AXIS2.,.POSITIVE.,-150.,$);\n"
      "#72=IFCMATERIALLAYERSET((#73,#74,#75),$,$);\n#73=IFCMATERIALLAYER(#76,15.,$,$,$,$,$);\n"
      "#74=IFCMATERIALLAYER(#77,270.,$,$,$,$,$);\n#75=IFCMATERIALLAYER(#78,15.,$,$,$,$,$);\n"
      "#76=IFCMATERIAL('Plaster',$,$);\n#77=IFCMATERIAL('Brick',$,$);\n#78=IFCMATERIAL('Render',$,$);\n"));
  std::map<std::string, double> areas;
  for (std::size_t p = 0; p < file.model.polygon_count(); ++p)
    areas[file.model.material_names[file.model.polygon_material[p].index()]] += area_of(file.model, p);
  EXPECT_NEAR(areas["Plaster"], 12.0 - 1.2, 1e-5);
  EXPECT_NEAR(areas["Render"], 12.0 - 1.2, 1e-5);
  EXPECT_NEAR(areas["Brick"], 2 * (1.2 + 0.9) + 0.3 * 4.4, 1e-5);
  for (std::size_t p = 0; p < file.model.polygon_count(); ++p) {
    if (file.model.material_names[file.model.polygon_material[p].index()] != "Plaster") continue;
    EXPECT_NEAR(file.model.vertices[file.model.loop(p)[0]].y, -0.15, 1e-6);
  }
}

TEST_F(Ifc, RefusalsAreOneLineWithTheFile) {
  EXPECT_THAT(refusal(test::ifc_text(test::kIfcFrame + test::kIfcWall, "IFC4X3")),
              HasSubstr("house.ifc: the schema IFC4X3 is not read"));
  const std::string text = test::ifc_text(test::kIfcFrame + test::kIfcWall);
  EXPECT_THAT(refusal(text.substr(0, 500)), HasSubstr("no element of this model has a body"));
  EXPECT_THAT(refusal("ISO-10303-21;\n#1=IFCWALL("), HasSubstr("its header names no schema"));
  EXPECT_THAT(refusal(""), HasSubstr("its header names no schema"));
}

TEST_F(Ifc, FileCutOffAnywhereIsReadOrRefusedInOneLine) {
  const std::string text = test::ifc_text(test::kIfcFrame + test::kIfcWall);
  for (std::size_t length = 300; length < text.size(); length += 97) {
    const std::string answer = refusal(text.substr(0, length));
    EXPECT_TRUE(answer == "accepted" || answer.find('\n') == std::string::npos) << answer;
    EXPECT_THAT(answer, testing::Not(HasSubstr("crash"))) << length;
  }
}

TEST(IfcHouseModels, FzkHasItsSpacesStoreysMaterialsAndGlass) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc");
  const auto file = read_model(test::ifc_file("AC20-FZK-Haus.ifc"));
  EXPECT_EQ(file.format, "IFC4");
  EXPECT_EQ(file.spaces.size(), 7U);
  EXPECT_THAT(file.model.part_names,
              AllOf(Contains("Erdgeschoss/Wall Wand-Ext-ERDG-1"), Contains("Dachgeschoss/Window OG-Fenster-1")));
  EXPECT_THAT(file.model.material_names, AllOf(Contains("Leichtbeton 102890359"), Contains("Kiefer, glänzend")));
  for (const SourceMaterial& material : file.materials) {
    EXPECT_EQ(material.name == "Glas", material.opacity == 0.0) << material.name;
  }
}

/// As a program that was started again finds its memory elsewhere, each import here finds it in other places than the one before.
TEST(IfcHouseModels, ImportsGiveTheSameWhereverTheirMemoryLies) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc");
  constexpr int kUsual = 128 * 1024;
  for (const char* house : {"AC20-FZK-Haus.ifc", "duplex.ifc"}) {
    const ModelFile once = read_model(test::ifc_file(house));
    for (const int mapped_from : {600, 4096}) {
      ::mallopt(M_MMAP_THRESHOLD, mapped_from);
      const ModelFile again = read_model(test::ifc_file(house));
      ::mallopt(M_MMAP_THRESHOLD, kUsual);
      EXPECT_EQ(again.model.vertices, once.model.vertices) << house;
      EXPECT_EQ(again.model.corners, once.model.corners) << house;
      EXPECT_EQ(again.model.polygon_material, once.model.polygon_material) << house;
    }
  }
}

TEST(IfcHouseModels, ThinSolidsOfGlassBecomeOnePaneEach) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc");
  const auto file = read_model(test::ifc_file("duplex.ifc"));
  EXPECT_EQ(file.spaces.size(), 21U);
  mesh::Model glass;
  glass.vertices = file.model.vertices;
  glass.material_names = file.model.material_names;
  glass.part_names = file.model.part_names;
  std::map<mesh::PartId, double> solid_area;
  for (std::size_t p = 0; p < file.model.polygon_count(); ++p) {
    const bool is_window =
        file.model.part_names[file.model.polygon_part[p].index()].find("Window") != std::string::npos;
    if (!is_window || file.materials[file.model.polygon_material[p].index()].opacity != 0.0) continue;
    glass.begin_polygon(file.model.polygon_material[p], file.model.polygon_part[p]);
    glass.add_loop(file.model.loop(p));
    solid_area[file.model.polygon_part[p]] += area_of(file.model, p);
  }
  EXPECT_EQ(solid_area.size(), 24U);
  mesh::CleanOptions options;
  options.sheet_materials.assign(glass.material_names.size(), true);
  const mesh::Model panes = mesh::clean(glass, options).polygons;
  std::map<mesh::PartId, double> pane_area;
  for (std::size_t p = 0; p < panes.polygon_count(); ++p) pane_area[panes.polygon_part[p]] += area_of(panes, p);
  EXPECT_EQ(pane_area.size(), 24U);
  for (const auto& [part, area] : pane_area) {
    EXPECT_LT(area, 0.5 * solid_area[part]);
    EXPECT_GT(area, 0.46 * solid_area[part]);  // the rim of a small pane is 4 % of it
  }
}

TEST(IfcHouseModels, AllOthersAreReadOrRefusedWithTheReason) {
  CLERESTORY_NEEDS_SHARED_DATA("ifc");
  for (const auto& entry : std::filesystem::directory_iterator(test::ifc_file(""))) {
    if (entry.path().extension() != ".ifc") continue;
    const std::string answer = test::refusal_of([&] { read_model(entry.path()); });
    if (entry.path().filename() == "Sample_entities.ifc") {
      EXPECT_THAT(answer, HasSubstr("no element of this model has a body"));
    } else {
      EXPECT_EQ(answer, "accepted") << entry.path();
    }
  }
}

}  // namespace
}  // namespace clerestory::io
