// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cleaned_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <nlohmann/json.hpp>

#include "mesh/error.h"
#include "tests/io/refusal.h"
#include "tests/support/places.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

namespace fs = std::filesystem;
using test::refusal_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

class CleanedModel : public testing::Test {
 protected:
  /// A square of two triangles far from the origin, one of them twice.
  CleanedModel() {
    test::write_text(model_,
                     "# metres\nv 600000 0 0\nv 600001 0 0\nv 600001 1 0\nv 600000 1 0\nusemtl red\no slab\n"
                     "f 1 2 3\nf 1 3 4\nf 1 3 4\n");
  }

  void clean_to(const fs::path& file) {
    const StudyInput input = read_study(model_, {.set = {}, .model_only = true});
    check_cleaned_model(file, input);
    mesh::CleanSurface surface = mesh::clean(input.study.model, input.study.clean);
    ModelReport report{.input = input, .file = "model.obj", .version = "9.9", .clean = surface.report};
    NoProgress progress;
    write_cleaned_model(file, std::move(surface), report, progress);
  }

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& entry : fs::directory_iterator(folder_.path())) list.push_back(entry.path().filename().string());
    return list;
  }

  test::ScratchFolder folder_;
  fs::path model_ = folder_.path() / "model.obj";
  fs::path out_ = folder_.path() / "clean.obj";
};

TEST_F(CleanedModel, StandsThereWithItsReportsAndNothingElse) {
  clean_to(out_);
  EXPECT_THAT(names(), UnorderedElementsAre("model.obj", "clean.obj", "clean.mtl", "clean.obj.report.txt",
                                            "clean.obj.report.json", "clean.obj.defects.vtp"));
  const auto json = nlohmann::json::parse(test::read_text(folder_.path() / "clean.obj.report.json"));
  EXPECT_EQ(json["defects"]["duplicate polygons"]["mended"], 1);
  EXPECT_THAT(json["files"], ElementsAre("clean.obj", "clean.mtl", "clean.obj.defects.vtp", "clean.obj.report.txt",
                                         "clean.obj.report.json"));
  EXPECT_THAT(test::read_text(folder_.path() / "clean.obj.report.txt"), HasSubstr("duplicate polygons: 1 found"));
}

TEST_F(CleanedModel, KeepsItsPlacePartsAndMaterials) {
  clean_to(out_);
  const ModelFile back = read_model(out_);
  EXPECT_EQ(back.model.polygon_count(), 2U);
  EXPECT_THAT(back.model.part_names, ElementsAre("slab"));
  EXPECT_THAT(back.model.material_names, ElementsAre("red"));
  EXPECT_THAT(back.model.vertices, testing::Contains(mesh::Point{600001.0, 1.0, 0.0}));
}

TEST_F(CleanedModel, CleanedOnceMoreIsTheSame) {
  clean_to(out_);
  const std::string once = test::read_text(out_);
  model_ = out_;
  const fs::path again = folder_.path() / "again.obj";
  clean_to(again);
  std::string twice = test::read_text(again);
  twice.replace(twice.find("again.mtl"), 9, "clean.mtl");
  EXPECT_EQ(twice, once);
}

/// What is written as polygons and read again is clean; what could not be mended, or is no defect, is told again.
TEST_F(CleanedModel, HousesAreCleanOnceCleaned) {
  for (const char* house : {"AC20-FZK-Haus.ifc", "duplex.ifc"}) {
    CLERESTORY_NEEDS_SHARED_DATA(fs::path("ifc") / house);
    model_ = test::shared_data_dir() / "ifc" / house;
    clean_to(out_);
    model_ = out_;
    const fs::path again = folder_.path() / "again.obj";
    clean_to(again);
    const auto first = nlohmann::json::parse(test::read_text(folder_.path() / "clean.obj.report.json"));
    const auto second = nlohmann::json::parse(test::read_text(folder_.path() / "again.obj.report.json"));
    for (const auto& [kind, defect] : second["defects"].items())
      EXPECT_EQ(defect["mended"], 0) << house << ": " << kind;
    EXPECT_EQ(second["area_after_m2"], first["area_after_m2"]) << house;
    EXPECT_EQ(second["open_edges"], first["open_edges"]) << house;
    EXPECT_EQ(second["closed_shells"], first["closed_shells"]) << house;
    EXPECT_EQ(second["two_sided_polygons"], first["two_sided_polygons"]) << house;
    EXPECT_EQ(read_model(again).model.vertices, read_model(out_).model.vertices) << house;
  }
}

TEST_F(CleanedModel, PolygonsBackToBackAreBothWritten) {
  test::write_text(model_,
                   "# metres\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3 4\nusemtl blue\nf 4 3 2 1\n");
  clean_to(out_);
  const mesh::Model back = read_model(out_).model;
  ASSERT_EQ(back.polygon_count(), 2U);
  EXPECT_THAT(back.loop(0), ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(back.material_names[back.polygon_material[0].index()], "red");
  EXPECT_THAT(back.loop(1), ElementsAre(3, 2, 1, 0));
  EXPECT_EQ(back.material_names[back.polygon_material[1].index()], "blue");
}

TEST_F(CleanedModel, EachDefectHasAMarkerInModelCoordinates) {
  clean_to(out_);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder_.path() / "clean.obj.defects.vtp").c_str());
  reader->Update();
  vtkPolyData* const data = reader->GetOutput();
  ASSERT_EQ(data->GetNumberOfVerts(), 1);
  EXPECT_GE(data->GetPoint(0)[0], 600000.0);
  for (const char* name : {"kind", "mended", "polygon", "size_m", "note"})
    EXPECT_NE(data->GetCellData()->GetAbstractArray(name), nullptr) << name;
}

TEST_F(CleanedModel, OursAreReplaced) {
  clean_to(out_);
  clean_to(out_);
  EXPECT_EQ(names().size(), 6U);
}

TEST_F(CleanedModel, FilesOfTheUserAreNot) {
  const fs::path mtl = folder_.path() / "clean.mtl";
  test::write_text(mtl, "newmtl precious\n");
  EXPECT_THAT(refusal_of([&] { clean_to(out_); }), HasSubstr("clean.mtl: is not of this program's making"));
  EXPECT_EQ(test::read_text(mtl), "newmtl precious\n");
  EXPECT_EQ(names().size(), 2U);
}

TEST_F(CleanedModel, TheModelItselfIsNotOverwritten) {
  EXPECT_THAT(refusal_of([&] { clean_to(model_); }), HasSubstr("model.obj: is read and would be overwritten"));
}

TEST_F(CleanedModel, PlacesThatCannotBeWrittenToAreNamedBeforeTheWork) {
  EXPECT_THAT(refusal_of([&] { clean_to(folder_.path() / "none" / "a.ply"); }), HasSubstr("there is no folder"));
  EXPECT_THAT(refusal_of([&] { clean_to(folder_.path() / "a.dwg"); }), HasSubstr("no model is written as '.dwg'"));
  EXPECT_THROW(clean_to(model_ / "a.ply"), MachineError);
  fs::create_directory(folder_.path() / "b.ply");
  EXPECT_THAT(refusal_of([&] { clean_to(folder_.path() / "b.ply"); }), HasSubstr("b.ply: is a folder"));
}

}  // namespace
}  // namespace clerestory::io
