// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/critical_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

/// A plate of 1 m × 1 m at z = 0, whatever the model's origin.
Faces plate() {
  Model model;
  support::add_quad(model, {-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0});
  return build_faces(clean(model, {}));
}

ShadowSource triangle_at(double z) {
  ShadowSource source;
  source.outline = {{{0, 0, z}, {1, 0, z}, {0.3, 0.7, z}}};
  source.normal = {0, 0, -1};
  return source;
}

std::vector<Wedge> wedges_of(const Occluders& occluders, const ShadowSource& source, std::size_t most = 1000) {
  std::vector<Wedge> wedges;
  for_each_wedge(occluders, source, {.most = most}, [&](const Wedge& w) { wedges.push_back(w); });
  return wedges;
}

TEST(CriticalSurfaces, AreThoseOfVerticesWithEdgesBothWays) {
  const Faces faces = plate();
  const auto wedges = wedges_of(Occluders(faces), triangle_at(2));
  const auto count = [&](Wedge::Kind kind, int order) {
    return std::count_if(wedges.begin(), wedges.end(),
                         [&](const Wedge& w) { return w.kind == kind && w.order == order; });
  };
  // One edge of the triangle is parallel to two of the plate: seen from its two ends, and with the plate's four corners.
  EXPECT_EQ(count(Wedge::Kind::kVertexEdge, 1), 4);
  EXPECT_EQ(count(Wedge::Kind::kVertexEdge, 2), 8);
  EXPECT_EQ(count(Wedge::Kind::kEdgeVertex, 1), 4);
  EXPECT_EQ(count(Wedge::Kind::kEdgeVertex, 2), 8);
}

TEST(CriticalSurfaces, LieInFrontOfTheSourceAlone) {
  const Faces faces = plate();
  const Occluders occluders(faces);
  EXPECT_TRUE(wedges_of(occluders, triangle_at(-2)).empty());
  EXPECT_TRUE(wedges_of(occluders, triangle_at(0)).empty());
  ShadowSource both = triangle_at(-2);
  both.two_sided = true;
  EXPECT_EQ(wedges_of(occluders, both).size(), 24U);
}

TEST(CriticalSurfaces, OfASunAreItsShadowEdges) {
  const Faces faces = plate();
  ShadowSource sun;
  sun.kind = ShadowSource::Kind::kDirection;
  sun.towards = {0, 0.6, 0.8};
  const auto wedges = wedges_of(Occluders(faces), sun);
  ASSERT_EQ(wedges.size(), 4U);
  for (const Wedge& w : wedges) {
    EXPECT_EQ(w.order, 0);
    EXPECT_TRUE(w.parallel);
  }
}

TEST(CriticalSurfaces, StopAtTheLimit) {
  const Faces faces = plate();
  const Occluders occluders(faces);
  EXPECT_EQ(wedges_of(occluders, triangle_at(2), 7).size(), 7U);
  EXPECT_FALSE(for_each_wedge(occluders, triangle_at(2), {.most = 7}, [](const Wedge&) {}));
  EXPECT_TRUE(for_each_wedge(occluders, triangle_at(2), {.most = 24}, [](const Wedge&) {}));
}

}  // namespace
}  // namespace clerestory::mesh
