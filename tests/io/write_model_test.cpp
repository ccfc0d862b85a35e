// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include "io/model_file.h"
#include "tests/io/refusal.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

namespace fs = std::filesystem;
using test::refusal_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

using Corners = std::vector<std::uint32_t>;

/// A floor, a wall with a window in it and a pane, 600 km from the origin.
mesh::Model house() {
  mesh::Model model;
  constexpr double kX = 612345.123456;
  constexpr double kY = 5412345.654321;
  model.vertices = {{kX, kY, 0.1},     {kX + 4, kY, 0.1}, {kX + 4, kY + 3, 0.1}, {kX, kY + 3, 0.1}, {kX, kY, 2.8},
                    {kX + 4, kY, 2.8}, {kX + 1, kY, 1.0}, {kX + 3, kY, 1.0},     {kX + 3, kY, 2.0}, {kX + 1, kY, 2.0}};
  model.material_names = {"oak, waxed", "white paint", "glass"};
  model.part_names = {"floor of room 1", "wall"};
  model.begin_polygon(mesh::MaterialId(0U), mesh::PartId(0U));
  model.add_loop(Corners{0, 1, 2, 3});
  model.begin_polygon(mesh::MaterialId(1U), mesh::PartId(1U));
  model.add_loop(Corners{0, 1, 5, 4});
  model.add_loop(Corners{6, 9, 8, 7});
  model.begin_polygon(mesh::MaterialId(2U), mesh::PartId(1U));
  model.add_loop(Corners{6, 7, 8, 9});
  return model;
}

std::vector<SourceMaterial> materials_of_house() {
  std::vector<SourceMaterial> materials(3);
  materials[0].name = "oak, waxed";
  materials[0].diffuse = {0.3, 0.2, 0.1};
  materials[1].name = "white paint";
  materials[2].name = "glass";
  materials[2].opacity = 0.25;
  return materials;
}

class WriteModel : public testing::Test {
 protected:
  std::vector<fs::path> write(const std::string& name) {
    const std::vector<SourceMaterial> materials = materials_of_house();
    return write_model(beside(name), {model_, materials});
  }
  ModelFile read_back(const std::string& name) {
    write(name);
    return read_model(beside(name));
  }
  fs::path beside(const std::string& name) const { return scratch_.path() / name; }

  mesh::Model model_ = house();

 private:
  test::ScratchFolder scratch_;
};

/// By material name [m²].
std::map<std::string, double> areas(const mesh::Model& model) {
  std::map<std::string, double> sums;
  for (std::size_t polygon = 0; polygon < model.polygon_count(); ++polygon) {
    const auto loop = model.loop(polygon);
    mesh::Vector sum;
    for (std::size_t k = 2; k < loop.size(); ++k)
      sum = sum + cross(model.vertices[loop[k - 1]] - model.vertices[loop[0]],
                        model.vertices[loop[k]] - model.vertices[loop[0]]);
    sums[model.material_names[model.polygon_material[polygon].index()]] += 0.5 * norm(sum);
  }
  return sums;
}

void expect_house(const ModelFile& file, double tolerance) {
  EXPECT_THAT(file.model.part_names, UnorderedElementsAre("floor of room 1", "wall"));
  EXPECT_THAT(file.model.material_names, UnorderedElementsAre("oak, waxed", "white paint", "glass"));
  constexpr double kArea = 1e-5;  // [m²]
  const auto area = areas(file.model);
  EXPECT_NEAR(area.at("oak, waxed"), 12.0, kArea);
  EXPECT_NEAR(area.at("white paint"), 4 * 2.7 - 2.0, kArea);
  EXPECT_NEAR(area.at("glass"), 2.0, kArea);
  EXPECT_EQ(file.unit, LengthUnit::kMetre);
  for (const mesh::Point& p : file.model.vertices) {
    double nearest = 1e9;
    for (const mesh::Point& q : house().vertices) nearest = std::min(nearest, norm(p - q));
    EXPECT_LE(nearest, tolerance);
  }
}

const SourceMaterial& material(const ModelFile& file, const std::string& name) {
  return *std::find_if(file.materials.begin(), file.materials.end(), [&](const auto& m) { return m.name == name; });
}

TEST_F(WriteModel, ObjComesBackToTheLastBitWithItsMaterials) {
  const ModelFile file = read_back("house.obj");
  expect_house(file, 0.0);
  EXPECT_EQ(file.files.size(), 2U);
  EXPECT_THAT(*material(file, "oak, waxed").diffuse, ElementsAre(0.3, 0.2, 0.1));
  EXPECT_FALSE(material(file, "white paint").diffuse.has_value());
  EXPECT_EQ(material(file, "glass").opacity, 0.25);
  EXPECT_THAT(write("house.obj"), ElementsAre(beside("house.obj"), beside("house.mtl")));
}

TEST_F(WriteModel, PlyComesBackToTheLastBitWithItsNames) { expect_house(read_back("house.ply"), 0.0); }

TEST_F(WriteModel, GltfComesBackWithItsMaterials) {
  // The importer keeps the whole metres of the centre, 5412347, exactly, and the rest in single precision.
  for (const char* name : {"house.gltf", "house.glb"}) {
    const ModelFile file = read_back(name);
    expect_house(file, 1e-6);
    EXPECT_THAT(*material(file, "oak, waxed").diffuse, ElementsAre(0.3, 0.2, 0.1));
    EXPECT_FALSE(material(file, "white paint").diffuse.has_value());
    EXPECT_EQ(material(file, "glass").opacity, 0.25);
  }
  EXPECT_THAT(write("house.gltf"), ElementsAre(beside("house.gltf"), beside("house.bin")));
}

TEST_F(WriteModel, GltfTellsTransmittance) {
  std::vector<SourceMaterial> materials = materials_of_house();
  materials[2].opacity.reset();
  materials[2].transmittance_normal = 0.6;
  write_model(beside("house.glb"), {model_, materials});
  EXPECT_NEAR(material(read_model(beside("house.glb")), "glass").transmittance_normal.value(), 0.6, 1e-6);
}

std::vector<std::string> strings(vtkPolyData* data, const char* name) {
  std::vector<std::string> values;
  auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfValues(); ++i) values.push_back(array->GetValue(i));
  return values;
}

TEST_F(WriteModel, VtpHasPartsAndMaterialsByCell) {
  write("house.vtp");
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(beside("house.vtp").c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  EXPECT_EQ(data->GetNumberOfPolys(), 4) << "the wall is cut in two at its window";
  EXPECT_EQ(data->GetPoint(0)[0], 612345.123456);
  EXPECT_THAT(strings(data, "part_names"), ElementsAre("floor of room 1", "wall"));
  EXPECT_THAT(strings(data, "material_names"), ElementsAre("oak, waxed", "white paint", "glass"));
  EXPECT_EQ(data->GetCellData()->GetArray("part")->GetTuple1(3), 1.0);
  EXPECT_EQ(data->GetCellData()->GetArray("material")->GetTuple1(3), 2.0);
}

TEST_F(WriteModel, NamesOfSeveralLinesStandInOne) {
  model_.part_names[0] = "floor\nv 1 2 3";
  EXPECT_THAT(read_back("house.obj").model.part_names, ElementsAre("floor v 1 2 3", "wall"));
}

TEST_F(WriteModel, PolygonsOfOnePartStandTogether) {
  model_.polygon_part = {mesh::PartId(1U), mesh::PartId(0U), mesh::PartId(1U)};
  EXPECT_THAT(polygons_by_part(model_), ElementsAre(1, 0, 2));
}

TEST_F(WriteModel, AnotherFormatIsRefused) {
  EXPECT_THAT(refusal_of([&] { write("house.ifc"); }),
              HasSubstr("house.ifc: no model is written as '.ifc'; choose one of .obj, .ply, .gltf, .glb, .vtp"));
  EXPECT_THAT(refusal_of([&] { static_cast<void>(model_files("house")); }), HasSubstr("no model is written as ''"));
}

TEST_F(WriteModel, AFolderThatIsNotThereIsTheMachinesFault) { EXPECT_THROW(write("none/house.ply"), MachineError); }

}  // namespace
}  // namespace clerestory::io
