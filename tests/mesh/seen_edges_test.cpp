// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/seen_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

/// Two plates at z = 1, a wall between them, and a lamp above the first.
TEST(SeenEdges, BehindAWallAreLeftOut) {
  Model model;
  support::add_quad(model, {-2, -0.5, 1}, {-1, -0.5, 1}, {-1, 0.5, 1}, {-2, 0.5, 1}, {"plate", "plate"});
  support::add_quad(model, {1, -0.5, 1}, {2, -0.5, 1}, {2, 0.5, 1}, {1, 0.5, 1}, {"plate", "plate"});
  support::add_quad(model, {0, -9, -9}, {0, 9, -9}, {0, 9, 9}, {0, -9, 9}, {"wall", "wall"});
  const Faces faces = build_faces(clean(model, {}));
  const Rays rays(faces);
  const Occluders occluders(faces);
  ShadowSource lamp;
  lamp.normal = {0, 0, -1};
  lamp.outline = {{{-1.8, -0.1, 2}, {-1.2, -0.1, 2}, {-1.2, 0.1, 2}, {-1.8, 0.1, 2}}};
  for (Point& p : lamp.outline[0]) p = p - faces.origin;
  const SeenEdges seen = seen_edges(occluders, lamp, rays);
  ASSERT_EQ(seen.lit.size(), occluders.edges().size());
  int lit = 0;
  for (std::size_t e = 0; e < seen.lit.size(); ++e) {
    const auto ends = occluders.ends(occluders.edges()[e]);
    const Point middle = midpoint(ends[0], ends[1]) + faces.origin;
    if (middle.x > 0.5) {
      EXPECT_EQ(seen.lit[e], 0);
    }
    if (middle.x < -0.5) lit += seen.lit[e];
    EXPECT_EQ(seen.outdoors[e], 0);
  }
  EXPECT_EQ(lit, 4);
}

}  // namespace
}  // namespace clerestory::mesh
