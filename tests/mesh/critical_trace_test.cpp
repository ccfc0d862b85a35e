// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/critical_trace.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

/// A floor at z = -1 and a shelf over half of it at z = -0.5; box of both centred, so that the model is not shifted.
Faces floor_and_shelf() {
  Model model;
  support::add_quad(model, {-2, -2, -0.4}, {2, -2, -0.4}, {2, 2, -0.4}, {-2, 2, -0.4}, {"floor", "floor"});
  support::add_quad(model, {0, -2, -0.2}, {2, -2, -0.2}, {2, 2, -0.2}, {0, 2, -0.2}, {"shelf", "shelf"});
  return build_faces(clean(model, {}));
}

/// The vertical plane y = 0 below a level edge.
Wedge vertical_wedge() {
  Wedge wedge;
  wedge.pivot = {0, 0, 1};
  wedge.edge = {Point{-0.5, 0, 0.5}, Point{0.5, 0, 0.5}};
  wedge.free_side = {0, 1, 0};
  return wedge;
}

TEST(CriticalTrace, EndsOnWhatIsNearestAlongEachLine) {
  const Faces faces = floor_and_shelf();
  ASSERT_EQ(norm(faces.origin), 0.0);
  const Occluders occluders(faces);
  const WedgeTracer tracer(faces, {}, occluders);
  std::vector<TracedPiece> pieces;
  tracer.trace(vertical_wedge(), pieces);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_NEAR(pieces[0].far[0].x, -1.4, 1e-12);
  EXPECT_NEAR(pieces[0].far[1].x, 0.0, 1e-12);
  EXPECT_NEAR(pieces[0].far[1].z, -0.4, 1e-12);
  EXPECT_NEAR(pieces[0].near[1].x, 0.0, 1e-12);
  EXPECT_NEAR(pieces[1].far[0].z, -0.2, 1e-12);
  EXPECT_NEAR(pieces[1].far[1].x, 1.2, 1e-12);
  EXPECT_EQ(pieces[1].side, Side::kFront);
}

TEST(CriticalTrace, IsShutByWhatIsBeforeTheEdge) {
  Model model;
  support::add_quad(model, {-2, -2, -0.4}, {2, -2, -0.4}, {2, 2, -0.4}, {-2, 2, -0.4}, {"floor", "floor"});
  support::add_quad(model, {0, -1, 0.4}, {1, -1, 0.4}, {1, 1, 0.4}, {0, 1, 0.4}, {"lid", "lid"});
  const Faces faces = build_faces(clean(model, {}));
  ASSERT_EQ(norm(faces.origin), 0.0);
  const Occluders occluders(faces);
  Wedge wedge = vertical_wedge();
  wedge.edge = {Point{-0.5, 0, 0.2}, Point{0.5, 0, 0.2}};
  std::vector<TracedPiece> pieces;
  WedgeTracer(faces, {}, occluders).trace(wedge, pieces);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_NEAR(pieces[0].far[1].x, 0.0, 1e-12);
}

TEST(CriticalTrace, GoesThroughThePivotOfAnEdgeVertexSurface) {
  const Faces faces = floor_and_shelf();
  const Occluders occluders(faces);
  Wedge wedge = vertical_wedge();
  wedge.kind = Wedge::Kind::kEdgeVertex;
  wedge.edge = {Point{-0.5, 0, 2.0}, Point{0.5, 0, 2.0}};
  std::vector<TracedPiece> pieces;
  WedgeTracer(faces, {}, occluders).trace(wedge, pieces);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_NEAR(pieces[0].far[0].x, 0.6, 1e-12);  // from the edge's first end, 1 m above the pivot, 1.2 m on
  EXPECT_NEAR(pieces[1].far[1].x, -0.7, 1e-12);
}

TEST(CriticalTrace, OfAWedgeWithoutAPlaneIsNothing) {
  const Faces faces = floor_and_shelf();
  const Occluders occluders(faces);
  Wedge wedge = vertical_wedge();
  wedge.edge = {Point{0, 0, 0.5}, Point{0, 0, 0}};
  std::vector<TracedPiece> pieces;
  WedgeTracer(faces, {}, occluders).trace(wedge, pieces);
  EXPECT_TRUE(pieces.empty());
}

}  // namespace
}  // namespace clerestory::mesh
