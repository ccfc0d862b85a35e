// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/vertex_index.h"

#include <gtest/gtest.h>

namespace clerestory::mesh {
namespace {

TEST(VertexIndex, GivesNearPointsTheFirstOnesNumber) {
  VertexIndex index(1e-3);
  EXPECT_EQ(index.add({0, 0, 0}), 0U);
  EXPECT_EQ(index.add({0.0009, 0, 0}), 0U);
  EXPECT_EQ(index.add({-0.0009, 0, 0}), 0U);
  EXPECT_EQ(index.add({0.0011, 0, 0}), 1U);
  EXPECT_EQ(index.add({0.0006, 0, 0}), 1U);  // nearer to the second
  EXPECT_EQ(index[0], (Point{0, 0, 0}));
}

TEST(VertexIndex, DoesNotCollapseAChain) {
  VertexIndex index(1e-3);
  for (int i = 0; i < 100; ++i) index.add({i * 0.7e-3, 0, 0});
  EXPECT_EQ(index.points().size(), 50U);
}

TEST(VertexIndex, TellsPointsApartFarFromTheOrigin) {
  VertexIndex index(2e-5);
  const double x = 612345.123456;
  EXPECT_EQ(index.add({x, x, -x}), 0U);
  EXPECT_EQ(index.add({x + 1e-5, x, -x}), 0U);
  EXPECT_EQ(index.add({x + 3e-5, x, -x}), 1U);
  EXPECT_FALSE(index.find({x, x + 1e-4, -x}).has_value());
}

}  // namespace
}  // namespace clerestory::mesh
