// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/element_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/shadow_regions.h"
#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

/// A room of 4 m × 4 m × 3 m with a lamp under the ceiling over a table top.
Study lamp_over_table() {
  mesh::Model model = support::box_room(4, 4, 3);
  support::add_quad(model, {1.5, 1.7, 2.9}, {1.5, 2.3, 2.9}, {2.5, 2.3, 2.9}, {2.5, 1.7, 2.9}, {"lamp", "lamp"});
  support::add_quad(model, {1.4, 1.4, 0.8}, {2.6, 1.4, 0.8}, {2.6, 2.6, 0.8}, {1.4, 2.6, 0.8}, {"table", "table"});
  Study study = test::study_of(std::move(model), 0.5, {2, 2, 1});
  test::shine(test::material(study, "lamp"), 5000.0);
  study.sky.type = Sky::Type::kNone;
  return study;
}

double area_of(const ElementMesh& mesh, std::size_t cell) {
  const mesh::Point& a = mesh.points[mesh.cells[cell][0]];
  return 0.5 * norm(cross(mesh.points[mesh.cells[cell][1]] - a, mesh.points[mesh.cells[cell][2]] - a));
}

TEST(ElementMesh, FloorBelowATableHasAnUmbraOfTheConstructedSize) {
  NoProgress progress;
  const MeshedStudy meshed = mesh_study(lamp_over_table(), false, progress);
  const ElementMesh& mesh = meshed.elements;
  double floor = 0.0;
  double umbra = 0.0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    EXPECT_GT(mesh.size_m[c], 0.0F);
    if (mesh.material_names[static_cast<std::size_t>(mesh.material[c])] != "floor" || mesh.side[c] != 0) continue;
    floor += area_of(mesh, c);
    if (mesh.shade[c] == static_cast<std::uint8_t>(mesh::Shade::kUmbra)) umbra += area_of(mesh, c);
  }
  EXPECT_NEAR(floor, 16.0, 1e-6);
  // The shadow of a point of the lamp is the table's, magnified by 2.9 / 2.1 and shifted by -0.8 / 2.1 of the point's place.
  const double magnified = 2.9 / 2.1 * 1.2;
  const double across = 0.8 / 2.1;
  EXPECT_NEAR(umbra, (magnified - across * 1.0) * (magnified - across * 0.6), 1e-3);
}

TEST(ElementMesh, LinesAloneLeaveTheElementsOut) {
  NoProgress progress;
  const MeshedStudy meshed = mesh_study(lamp_over_table(), true, progress);
  EXPECT_TRUE(meshed.elements.cells.empty());
  ASSERT_GT(meshed.lines.ends.size(), 8U);
  EXPECT_EQ(meshed.lines.order.size(), meshed.lines.ends.size());
  EXPECT_EQ(meshed.lines.source_names.at(0), "lamp");
  EXPECT_EQ(meshed.lines.part_names[static_cast<std::size_t>(meshed.lines.occluder[0])], "table");
}

}  // namespace
}  // namespace clerestory::lighting
