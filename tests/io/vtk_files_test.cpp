// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/vtk_files.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <locale>

#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLPolyDataReader.h>

#include "mesh/error.h"
#include "tests/io/sample_results.h"

namespace clerestory::io {
namespace {

class VtkFiles : public testing::Test {
 protected:
  VtkFiles() { std::filesystem::create_directories(folder_); }
  ~VtkFiles() override { std::filesystem::remove_all(folder_); }

  static vtkSmartPointer<vtkPolyData> read(const std::filesystem::path& file) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader->GetOutput();
  }

  static std::string bytes(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  static std::string word(vtkPolyData* data, const char* name, int index = 0) {
    auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
    return array == nullptr || array->GetNumberOfValues() <= index ? "(missing)" : std::string(array->GetValue(index));
  }

  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("vtk_files_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  lighting::GridResult grid_ = test::office_grid();
  lighting::Results results_ = test::make_results(grid_);
  ResultContext context_ = test::daylight_context();
};

/// Numbers with a decimal comma and points between thousands.
class GermanNumbers : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST_F(VtkFiles, GridIsReadBackAsQuadrilateralsWithItsValues) {
  write_grid_vtp(folder_ / "workplane.vtp", results_, std::span(&grid_, 1), context_);
  const auto data = read(folder_ / "workplane.vtp");
  ASSERT_EQ(data->GetNumberOfPolys(), 24 * 32);
  EXPECT_EQ(data->GetNumberOfPoints(), 825);  // 25 by 33, shared by neighbours
  for (const auto& [name, values] :
       {std::pair{"illuminance_lux", &grid_.illuminance_lux}, std::pair{"error_lux", &grid_.error_lux},
        std::pair{"daylight_factor_percent", &grid_.daylight_factor_percent}}) {
    vtkDataArray* const array = data->GetCellData()->GetArray(name);
    ASSERT_NE(array, nullptr) << name;
    ASSERT_EQ(array->GetNumberOfTuples(), 24 * 32);
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
      ASSERT_EQ(array->GetTuple1(i), static_cast<double>((*values)[static_cast<std::size_t>(i)]));
    }
  }
  EXPECT_EQ(word(data, "sky"), context_.sky);
  EXPECT_EQ(word(data, "grid"), "workplane");
}

TEST_F(VtkFiles, GridWithoutCellsIsReadBackAsVertices) {
  grid_.sensors.cells.clear();
  grid_.daylight_factor_percent.clear();
  write_grid_vtp(folder_ / "desk.vtp", results_, std::span(&grid_, 1), context_);
  const auto data = read(folder_ / "desk.vtp");
  EXPECT_EQ(data->GetNumberOfVerts(), 24 * 32);
  EXPECT_EQ(data->GetNumberOfPolys(), 0);
  EXPECT_EQ(data->GetCellData()->GetArray("daylight_factor_percent"), nullptr);
  EXPECT_EQ(data->GetCellData()->GetArray("illuminance_lux")->GetNumberOfTuples(), 24 * 32);
}

TEST_F(VtkFiles, SurfacesAreReadBackInDoublePrecisionWithAllArrays) {
  write_surfaces_vtp(folder_ / "surfaces.vtp", results_, context_);
  const auto data = read(folder_ / "surfaces.vtp");
  ASSERT_EQ(data->GetNumberOfPolys(), 2);
  EXPECT_EQ(data->GetPoint(0)[0], 612345.123456);
  for (const char* name : {"illuminance_lux", "error_lux", "radiosity_lm_m2", "luminance_cd_m2", "reflectance", "side",
                           "level", "part", "material", "room"}) {
    EXPECT_NE(data->GetCellData()->GetArray(name), nullptr) << name;
  }
  EXPECT_EQ(data->GetCellData()->GetArray("room")->GetTuple1(1), -1.0);
  EXPECT_EQ(data->GetCellData()->GetArray("side")->GetTuple1(1), 1.0);
  EXPECT_EQ(data->GetPointData()->GetArray("illuminance_lux")->GetTuple1(2), 300.0);
  EXPECT_EQ(data->GetPointData()->GetNormals()->GetComponent(4, 2), -1.0);
  EXPECT_EQ(word(data, "part_names"), "desk <1> & \"süd\"");
  EXPECT_EQ(word(data, "material_names", 1), "wood");
  EXPECT_EQ(word(data, "room_names"), "room 1");
  EXPECT_EQ(word(data, "version"), "0.1.0");
  EXPECT_EQ(word(data, "units", 2), "radiosity_lm_m2: lm/m²");
  EXPECT_EQ(data->GetFieldData()->GetArray("horizontal_illuminance_lux")->GetTuple1(0), 10'000.0);
}

TEST_F(VtkFiles, SurfacesWithoutElementsAreReadBackEmpty) {
  write_surfaces_vtp(folder_ / "surfaces.vtp", {}, context_);
  EXPECT_EQ(read(folder_ / "surfaces.vtp")->GetNumberOfCells(), 0);
}

TEST_F(VtkFiles, CollectionOpensAllFilesByName) {
  write_grid_vtp(folder_ / "work & plane.vtp", results_, std::span(&grid_, 1), context_);
  write_surfaces_vtp(folder_ / "surfaces.vtp", results_, context_);
  write_result_vtm(folder_ / "result.vtm", {{"surfaces", "surfaces.vtp"}, {"<work & plane>", "work & plane.vtp"}});
  vtkNew<vtkXMLMultiBlockDataReader> reader;
  reader->SetFileName((folder_ / "result.vtm").c_str());
  reader->Update();
  auto* const blocks = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput());
  ASSERT_NE(blocks, nullptr);
  ASSERT_EQ(blocks->GetNumberOfBlocks(), 2U);
  EXPECT_STREQ(blocks->GetMetaData(1U)->Get(vtkCompositeDataSet::NAME()), "<work & plane>");
  EXPECT_EQ(vtkPolyData::SafeDownCast(blocks->GetBlock(0))->GetNumberOfPolys(), 2);
  EXPECT_EQ(vtkPolyData::SafeDownCast(blocks->GetBlock(1))->GetNumberOfPolys(), 24 * 32);
}

TEST_F(VtkFiles, BytesDoNotDependOnTheLocale) {
  write_surfaces_vtp(folder_ / "plain.vtp", results_, context_);
  const std::locale before = std::locale::global(std::locale(std::locale(), new GermanNumbers));
  write_surfaces_vtp(folder_ / "german.vtp", results_, context_);
  std::locale::global(before);
  EXPECT_EQ(bytes(folder_ / "plain.vtp"), bytes(folder_ / "german.vtp"));
}

TEST_F(VtkFiles, LargeGridIsCompressed) {
  const auto large = test::make_grid({.columns = 300, .rows = 300}, [](double, double) { return 2.0; });
  write_grid_vtp(folder_ / "large.vtp", results_, std::span(&large, 1), context_);
  // 90,601 points of 24 bytes, 90,000 cells of 4 corners of 8 bytes and 28 bytes of values each.
  EXPECT_LT(std::filesystem::file_size(folder_ / "large.vtp"), 2'000'000U);
  EXPECT_EQ(read(folder_ / "large.vtp")->GetNumberOfPolys(), 90'000);
}

TEST_F(VtkFiles, FileThatCannotBeWrittenIsAnErrorThatNamesIt) {
  const auto file = folder_ / "missing" / "surfaces.vtp";
  try {
    write_surfaces_vtp(file, results_, context_);
    FAIL() << "no error";
  } catch (const MachineError& error) {
    EXPECT_NE(std::string(error.what()).find("missing/surfaces.vtp"), std::string::npos);
  }
  EXPECT_THROW(write_result_vtm(folder_ / "missing" / "result.vtm", {}), MachineError);
}

TEST_F(VtkFiles, LeaksArePointsWithTheirRooms) {
  EXPECT_FALSE(has_leaks(results_));
  using Kind = mesh::RoomOpening::Kind;
  results_.rooms.resize(2);
  results_.rooms[0].name = "office";
  results_.rooms[0].openings = {{Kind::kGlazing, mesh::kNoRoom, 2.0, {1, 0, 1}}};
  EXPECT_FALSE(has_leaks(results_));
  results_.rooms[1].name = "store";
  results_.rooms[1].openings = {{Kind::kHole, 0, 1.5, {4, 4, 4}},
                                {Kind::kHole, mesh::kNoRoom, 0.25, {600'000.125, 2, 3}}};
  EXPECT_TRUE(has_leaks(results_));
  write_leaks_vtp(folder_ / "leaks.vtp", results_, context_);
  const auto data = read(folder_ / "leaks.vtp");
  ASSERT_EQ(data->GetNumberOfPoints(), 1);
  ASSERT_EQ(data->GetNumberOfVerts(), 1);
  EXPECT_EQ(data->GetPoint(0)[0], 600'000.125);
  EXPECT_EQ(data->GetCellData()->GetArray("room")->GetTuple1(0), 1.0);
  EXPECT_EQ(data->GetCellData()->GetArray("area_m2")->GetTuple1(0), 0.25);
  EXPECT_EQ(word(data, "room_names", 1), "store");
}

}  // namespace
}  // namespace clerestory::io
