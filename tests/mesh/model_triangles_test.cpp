// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/model_triangles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace clerestory::mesh {
namespace {

using Corners = std::vector<std::uint32_t>;

/// A square of 4 m with a square hole of 1 m, wound the same way, and a pentagon beside it; far from the origin.
Model wall_and_pentagon() {
  Model model;
  constexpr double kFar = 600e3;
  for (const auto& [x, z] : std::vector<std::array<double, 2>>{{0, 0},
                                                               {4, 0},
                                                               {4, 4},
                                                               {0, 4},
                                                               {1, 1},
                                                               {2, 1},
                                                               {2, 2},
                                                               {1, 2},
                                                               {5, 0},
                                                               {6, 0},
                                                               {6.5, 1},
                                                               {5.5, 0.5},
                                                               {5, 1}})
    model.vertices.push_back({kFar + x, 7.0, z});
  model.material_names = {"white", "red"};
  model.part_names = {"wall", "sign"};
  model.begin_polygon(MaterialId(0U), PartId(0U), 11);
  model.add_loop(Corners{0, 1, 2, 3});
  model.add_loop(Corners{4, 5, 6, 7});
  model.begin_polygon(MaterialId(1U), PartId(1U), 12);
  model.add_loop(Corners{8, 9, 10, 11, 12});
  return model;
}

Vector doubled_area_of(const Model& model, PartId part) {
  Vector sum;
  for (std::size_t polygon = 0; polygon < model.polygon_count(); ++polygon) {
    if (model.polygon_part[polygon] != part) continue;
    const auto loop = model.loop(polygon);
    for (std::size_t k = 2; k < loop.size(); ++k)
      sum = sum + cross(model.vertices[loop[k - 1]] - model.vertices[loop[0]],
                        model.vertices[loop[k]] - model.vertices[loop[0]]);
  }
  return sum;
}

TEST(ModelTriangles, OnlyPolygonsWithHolesAreCutAtThem) {
  const Model cut = cut_at_holes(wall_and_pentagon());
  ASSERT_EQ(cut.polygon_count(), 3U);  // round a hole there are two pieces at least
  std::size_t corners = 0;
  for (const std::size_t polygon : {0U, 1U}) {
    EXPECT_EQ(cut.loop_count(polygon), 1U);
    corners += cut.loop(polygon).size();
  }
  EXPECT_EQ(corners, 8U + 4U);  // the two cuts end at four corners
  EXPECT_EQ(cut.loop(2).size(), 5U);
  EXPECT_EQ(cut.vertices.size(), 13U);
  EXPECT_EQ(cut.polygon_line[0], 11U);
  EXPECT_EQ(cut.polygon_material[2], MaterialId(1U));
  EXPECT_EQ(cut.part_names, wall_and_pentagon().part_names);
  EXPECT_NEAR(doubled_area_of(cut, PartId(0U)).y, -2.0 * 15.0, 1e-9);
}

TEST(ModelTriangles, AreaAndWindingStay) {
  const Model cut = cut_into_triangles(wall_and_pentagon());
  for (std::size_t polygon = 0; polygon < cut.polygon_count(); ++polygon) {
    EXPECT_EQ(cut.loop_count(polygon), 1U);
    EXPECT_EQ(cut.loop(polygon).size(), 3U);
  }
  EXPECT_NEAR(doubled_area_of(cut, PartId(0U)).y, -2.0 * 15.0, 1e-9);
  EXPECT_NEAR(doubled_area_of(cut, PartId(1U)).y, -2.0 * 0.875, 1e-9);
  EXPECT_EQ(cut.polygon_count(), 8U + 3U);
}

TEST(ModelTriangles, APolygonWithoutAreaVanishes) {
  Model model;
  model.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  model.material_names = {"a"};
  model.part_names = {"a"};
  model.begin_polygon(MaterialId(0U), PartId(0U));
  model.add_loop(Corners{0, 1, 2, 3});
  EXPECT_EQ(cut_into_triangles(model).polygon_count(), 0U);
}

}  // namespace
}  // namespace clerestory::mesh
