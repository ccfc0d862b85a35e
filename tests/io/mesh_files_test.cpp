// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include <filesystem>

#include "tests/io/sample_results.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::HasSubstr;

/// One triangle, lit from the front, and one line on it.
lighting::MeshedStudy one_triangle() {
  lighting::MeshedStudy meshed;
  lighting::ElementMesh& mesh = meshed.elements;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.cells = {{0, 1, 2}};
  mesh.side = {0};
  mesh.level = {3};
  mesh.size_m = {1.5F};
  mesh.min_angle_deg = {45.0F};
  mesh.part = {0};
  mesh.material = {0};
  mesh.face = {0};
  mesh.region = {0};
  mesh.patch = {2};
  mesh.shade = {1};
  mesh.part_names = {"floor"};
  mesh.material_names = {"oak"};
  meshed.lines.ends = {{mesh::Point{0, 0, 0}, mesh::Point{0.5, 0.5, 0}}};
  meshed.lines.order = {1};
  meshed.lines.no_sky = {1};
  meshed.lines.side = {0};
  meshed.lines.source = {0};
  meshed.lines.occluder = {0};
  meshed.lines.part = {0};
  meshed.lines.source_names = {"window"};
  meshed.lines.part_names = {"floor"};
  meshed.selection.found = {0, 4, 7};
  meshed.selection.kept_count = {0, 1, 0};
  meshed.selection.merged = 3;
  meshed.notices = {"a notice", "a notice"};
  return meshed;
}

vtkSmartPointer<vtkPolyData> read(const std::filesystem::path& file) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

double value(vtkPolyData* data, const char* name) { return data->GetCellData()->GetArray(name)->GetTuple1(0); }

TEST(MeshFiles, ElementsAndLinesAreReadBackWithTheirValues) {
  const test::ScratchFolder folder;
  NoProgress progress;
  const std::string summary = write_mesh(folder.path(), one_triangle(), test::daylight_context(), progress);
  EXPECT_THAT(summary, HasSubstr("\"d2\": 7"));
  const auto elements = read(folder.path() / "elements.vtp");
  ASSERT_EQ(elements->GetNumberOfPolys(), 1);
  EXPECT_EQ(value(elements, "level"), 3.0);
  EXPECT_EQ(value(elements, "patch"), 2.0);
  EXPECT_EQ(value(elements, "shade"), 1.0);
  const auto lines = read(folder.path() / "discontinuities.vtp");
  ASSERT_EQ(lines->GetNumberOfLines(), 1);
  EXPECT_EQ(value(lines, "order"), 1.0);
  EXPECT_EQ(value(lines, "no_sky"), 1.0);
}

TEST(MeshFiles, LinesAloneReplaceAnOlderMesh) {
  const test::ScratchFolder folder;
  NoProgress progress;
  lighting::MeshedStudy meshed = one_triangle();
  write_mesh(folder.path(), meshed, test::daylight_context(), progress);
  meshed.elements = {};
  write_mesh(folder.path(), meshed, test::daylight_context(), progress);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "elements.vtp"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "discontinuities.vtp"));
}

TEST(MeshFiles, ReportTellsFoundAndKeptAndEachNoticeOnce) {
  const std::string report = mesh_report(one_triangle(), "out");
  EXPECT_THAT(report, HasSubstr("1 kept of 11 found"));
  EXPECT_EQ(report.find("a notice"), report.rfind("a notice"));
}

}  // namespace
}  // namespace clerestory::io
