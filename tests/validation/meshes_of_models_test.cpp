// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of collected models are conforming.
#include <gtest/gtest.h>

#include <cctype>
#include <string>

#include "io/study_file.h"
#include "lighting/scene.h"
#include "mesh/faces.h"
#include "tests/support/places.h"
#include "tests/support/surface_checks.h"

namespace clerestory {
namespace {

class MeshesOfModels : public testing::TestWithParam<std::string> {};

TEST_P(MeshesOfModels, AreConforming) {
  CLERESTORY_NEEDS_SHARED_DATA(GetParam());
  const auto study = io::read_study(test::shared_data_dir() / GetParam(), {}).study;
  const mesh::Faces faces = lighting::build_scene(study).faces;
  mesh::MeshOptions options;
  options.max_size_m = 1e9;
  const support::MeshFaults faults = support::mesh_faults(faces, mesh::mesh_faces(faces, options));
  EXPECT_EQ(faults.turned_or_empty, 0U);
  EXPECT_EQ(faults.edges_used_twice, 0U);
  EXPECT_EQ(faults.open_edges, 0U);
  EXPECT_EQ(faults.loose_vertices, 0U);
  EXPECT_LT(faults.area_error, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Collected, MeshesOfModels,
                         testing::Values("ifc/duplex.ifc", "ifc/AC20-FZK-Haus.ifc",
                                         "office-london/derived_london-office.obj"),
                         [](const auto& one) {
                           std::string name = one.param.substr(one.param.rfind('/') + 1);
                           std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
                           return name;
                         });

}  // namespace
}  // namespace clerestory
