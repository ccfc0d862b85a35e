// SPDX-License-Identifier: GPL-3.0-or-later
// Models collected from the tests of assimp and tinyobjloader: each is read, or refused with a reason that is stated here.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "io/model_file.h"
#include "tests/io/refusal.h"
#include "tests/support/places.h"

namespace clerestory::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Files that are refused, and what of the message says why. All others are read.
const std::map<std::string, std::string> kRefused{
    // Points and lines alone, or nothing.
    {"empty.obj", "empty.obj: there is no face in this model"},
    {"issue-356-leading-spaces-newmtl.obj", "there is no face in this model"},
    {"line-prim.obj", "there is no face in this model"},
    {"point_cloud.obj", "there is no face in this model"},
    {"points-prim.obj", "there is no face in this model"},
    {"points.ply", "there is no face in this model"},
    {"testline.obj", "there is no face in this model"},
    {"testpoints.obj", "there is no face in this model"},
    // Faces without enough corners, or with corners that do not exist.
    {"invalid-face-definition.obj", "obj:15: a face has at least 3 corners, this one has 1"},
    {"invalid-relative-texture-index.obj", "obj:2: vertex 1 does not exist: the model has 0"},
    {"invalid-relative-vertex-index.obj", "obj:1: vertex -4 does not exist"},
    {"issue-140-zero-face-idx.obj", "obj:16: the vertex number 0 means nothing"},
    {"malformed.obj", "malformed.obj:28: the vertex number 0 means nothing"},
    {"malformed2.obj", "malformed2.obj:23: a face has at least 3 corners, this one has 0"},
    // Numbers that are none, and lines that are incomplete.
    {"issue623.ply", "issue623.ply:14: this line has 6 numbers, the header asks for more"},
    {"number_formats.obj", "number_formats.obj:11: the coordinate '3.1+e2' is no finite number"},
    // Materials that were not collected with the model.
    {"issue-244-mtl-searchpaths.obj", "obj:2: there is no MTL file 'issue-244.mtl'"},
    {"mtl_different_folder.obj", "obj:8: there is no MTL file 'folder/mtl_different_folder.mtl'"},
    {"tr-and-d-issue-43.obj", "obj:4: there is no MTL file 'tr-and-d-issue-43.mtl'"},
};

std::string outcome_of(const fs::path& model) {
  const std::string outcome = test::refusal_of([&] { read_model(model); });
  EXPECT_EQ(outcome.find('\n'), std::string::npos) << outcome;
  return outcome;
}

TEST(CollectedModels, EachIsReadOrRefusedForItsReason) {
  CLERESTORY_NEEDS_SHARED_DATA("cad-assimp");
  CLERESTORY_NEEDS_SHARED_DATA("cad-tinyobj");
  std::size_t read = 0;
  std::size_t refused = 0;
  for (const char* folder : {"cad-assimp", "cad-tinyobj"}) {
    for (const auto& entry : fs::recursive_directory_iterator(test::shared_data_dir() / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".obj" && extension != ".stl" && extension != ".ply") continue;
      const auto reason = kRefused.find(entry.path().filename().string());
      const std::string outcome = outcome_of(entry.path());
      reason == kRefused.end() ? ++read : ++refused;
      EXPECT_THAT(outcome, HasSubstr(reason == kRefused.end() ? "accepted" : reason->second)) << entry.path();
    }
  }
  EXPECT_EQ(refused, kRefused.size());
  EXPECT_GT(read, 60U);
}

std::string size_of(const std::string& model) {
  const auto file = read_model(test::shared_data_dir() / "cad-assimp" / model);
  return fmt::format("{}: {} faces, {} vertices, {} parts", file.format, file.model.polygon_count(),
                     file.model.vertices.size(), file.model.part_names.size());
}

TEST(CollectedModels, AreReadWhole) {
  CLERESTORY_NEEDS_SHARED_DATA("cad-assimp");
  EXPECT_EQ(size_of("STL/Spider_ascii.stl"), "STL: 1368 faces, 722 vertices, 1 parts");
  EXPECT_EQ(size_of("STL/Spider_binary.stl"), "STL: 1368 faces, 722 vertices, 1 parts");
  EXPECT_EQ(size_of("STL/sphereWithHole.stl"), "STL: 285 faces, 146 vertices, 1 parts");
  EXPECT_EQ(size_of("STL/triangle_with_two_solids.stl"), "STL: 2 faces, 6 vertices, 2 parts");
  EXPECT_EQ(size_of("PLY/cube.ply"), "PLY: 6 faces, 8 vertices, 1 parts");
  EXPECT_EQ(size_of("PLY/cube_binary.ply"), "PLY: 12 faces, 8 vertices, 1 parts");
  EXPECT_EQ(size_of("PLY/cube_binary_header_with_RN_newline.ply"), "PLY: 12 faces, 8 vertices, 1 parts");
  EXPECT_EQ(size_of("PLY/cube_binary_starts_with_nl.ply"), "PLY: 6 faces, 8 vertices, 1 parts");
  EXPECT_EQ(size_of("PLY/cube_uv.ply"), "PLY: 6 faces, 24 vertices, 1 parts");
  EXPECT_EQ(size_of("OBJ/box_UTF16BE.obj"), "OBJ: 6 faces, 8 vertices, 1 parts");
}

}  // namespace
}  // namespace clerestory::io
