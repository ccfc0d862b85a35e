// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/regions.h"

#include <gtest/gtest.h>

#include "mesh/clean.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

TEST(Regions, AThinSolidWallDividesTheFloorInThree) {
  const Faces faces = build_faces(clean(support::two_rooms_with_thin_wall({.thickness_m = 0.1}), {}));
  const Regions regions = number_regions(faces);
  std::vector<double> floor_areas;
  std::vector<double> widths;
  for (std::size_t r = 0; r < regions.count(); ++r) {
    if (faces.material_names[faces.faces[regions.face[r].index()].material.index()] != "floor") continue;
    floor_areas.push_back(regions.area_m2[r]);
    widths.push_back(regions.width_m[r]);
  }
  std::sort(floor_areas.begin(), floor_areas.end());
  ASSERT_EQ(floor_areas.size(), 3U);
  EXPECT_NEAR(floor_areas[0], 0.4, 1e-9);
  EXPECT_NEAR(floor_areas[1], 2.95 * 4.0, 1e-9);
  EXPECT_NEAR(floor_areas[2], 2.95 * 4.0, 1e-9);
  EXPECT_NEAR(*std::ranges::min_element(widths), 2.0 * 0.4 / 8.2, 1e-9);
}

TEST(Regions, PointsSpreadEvenlyOverARegionAndStayInside) {
  const Faces faces = build_faces(clean(support::l_room(), {}));
  const Regions regions = number_regions(faces);
  std::size_t floor = 0;
  while (faces.material_names[faces.faces[regions.face[floor].index()].material.index()] != "floor") ++floor;
  const RegionPoints points(faces, regions, floor);
  int in_corner = 0;
  for (std::uint32_t i = 0; i < 1200; ++i) {
    const Point p = points.at(i) + faces.origin;
    EXPECT_NEAR(p.z, 0.0, 1e-9);
    EXPECT_TRUE(p.x > 0.0 && p.y > 0.0 && p.x < 4.0 && p.y < 4.0 && (p.x < 2.0 || p.y < 2.0)) << p.x << ' ' << p.y;
    if (p.x < 2.0 && p.y < 2.0) ++in_corner;
  }
  EXPECT_NEAR(in_corner, 400, 20) << "a third of the area";
}

}  // namespace
}  // namespace clerestory::mesh
