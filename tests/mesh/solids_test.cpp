// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/solids.h"

#include <gtest/gtest.h>

namespace clerestory::mesh {
namespace {

std::vector<Point> rectangle(double x0, double y0, double x1, double y1, double z = 0.0) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

Solid box(double x0, double y0, double x1, double y1, double z0, double z1) {
  const auto loop = rectangle(x0, y0, x1, y1, z0);
  return snapped(prism({&loop, 1}, {0.0, 0.0, z1 - z0}));
}

TEST(Solids, PrismOfARingHasItsVolumeAndArea) {
  const std::vector loops{rectangle(0, 0, 4, 3), rectangle(1, 1, 2, 2)};
  const Solid ring = snapped(prism(loops, {0.0, 0.0, 2.0}));
  EXPECT_TRUE(is_closed(ring));
  EXPECT_NEAR(volume(ring), 22.0, 1e-12);
  EXPECT_NEAR(surface_area(ring), 2 * 11.0 + 2 * (14.0 + 4.0), 1e-12);
}

TEST(Solids, PrismIsOutwardWhateverTheLoopsAndTheExtrusionsSense) {
  auto loop = rectangle(0, 0, 1, 1);
  EXPECT_GT(volume(prism({&loop, 1}, {0.0, 0.0, -1.0})), 0.999);
  std::reverse(loop.begin(), loop.end());
  EXPECT_GT(volume(prism({&loop, 1}, {0.0, 0.0, 1.0})), 0.999);
}

TEST(Solids, LoopsBesideEachOtherAndIslandsInHolesAreFilled) {
  const std::vector loops{rectangle(0, 0, 9, 9), rectangle(1, 1, 8, 8), rectangle(2, 2, 3, 3), rectangle(20, 0, 21, 1)};
  Solid face;
  add_face(face, loops);
  EXPECT_NEAR(surface_area(face), 81.0 - 49.0 + 1.0 + 1.0, 1e-12);
}

TEST(Solids, FaceKeepsTheFrontOfItsOuterLoopWhereverThatStands) {
  auto hole = rectangle(1, 1, 2, 2);
  auto outer = rectangle(0, 0, 4, 3);
  std::reverse(outer.begin(), outer.end());
  Solid face;
  add_face(face, std::vector{hole, outer});
  const auto& [a, b, c] = face.triangles.front();
  EXPECT_LT(cross(face.points[b] - face.points[a], face.points[c] - face.points[a]).z, 0.0);
}

TEST(Solids, FaceWithoutAreaAddsNothing) {
  Solid face;
  add_face(face, std::vector<std::vector<Point>>{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}});
  add_face(face, std::vector<std::vector<Point>>{});
  EXPECT_TRUE(face.empty());
}

TEST(Solids, MirroredBodyStaysOutward) {
  const Solid mirrored = transformed(box(0, 0, 1, 2, 0, 3), {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 0, 0}});
  EXPECT_NEAR(volume(mirrored), 6.0, 1e-12);
}

TEST(Solids, OpenShellIsNotClosed) {
  Solid shell = box(0, 0, 1, 1, 0, 1);
  shell.triangles.pop_back();
  EXPECT_FALSE(is_closed(shell));
}

TEST(Solids, PiecesAreWhatHangsTogether) {
  Solid both = box(0, 0, 1, 1, 0, 1);
  append(both, box(5, 0, 6, 1, 0, 2));
  const auto pieces = connected_pieces(both);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_NEAR(volume(pieces[0]), 1.0, 1e-12);
  EXPECT_NEAR(volume(pieces[1]), 2.0, 1e-12);
}

TEST(Solids, AnAffineMapAndItsInverseAreTheIdentity) {
  const Affine map{{0.8, 0.6, 0.0}, {-0.6, 0.8, 0.1}, {0.0, 0.3, 2.0}, {612345.6, -7.0, 1.0}};
  const Point p{3.0, 4.0, 5.0};
  EXPECT_LT(norm(inverse(map)(map(p)) - p), 1e-9);
  EXPECT_LT(norm((inverse(map) * map)(p)-p), 1e-9);
}

}  // namespace
}  // namespace clerestory::mesh
