// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/silhouettes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

Faces faces_from(const Model& model) { return build_faces(clean(model, {})); }

std::size_t silhouettes_from(const Occluders& occluders, const Point& eye) {
  return static_cast<std::size_t>(
      std::count_if(occluders.edges().begin(), occluders.edges().end(), [&](const OccluderEdge& e) {
        const auto ends = occluders.ends(e);
        return occluders.free_side(e, midpoint(ends[0], ends[1]) - eye).has_value();
      }));
}

Model box() {
  Model model;
  support::add_box(model, {-1, -1, -1}, {1, 1, 1});
  return model;
}

TEST(Silhouettes, BoxShowsSixEdgesFromACornerAndFourFromAFace) {
  const Faces faces = faces_from(box());
  const Occluders occluders(faces);
  EXPECT_EQ(occluders.edges().size(), 12U);
  EXPECT_EQ(silhouettes_from(occluders, {5, 6, 7}), 6U);
  EXPECT_EQ(silhouettes_from(occluders, {0.1, 0.2, 7}), 4U);
}

TEST(Silhouettes, CornersOfARoomAreNoneFromInside) {
  const Faces faces = faces_from(support::box_room(4, 4, 4));
  EXPECT_EQ(silhouettes_from(Occluders(faces), {0.1, 0.2, 0.3}), 0U);
}

TEST(Silhouettes, FreeSideLooksAwayFromTheSurface) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  Faces faces = faces_from(model);
  const Occluders occluders(faces);
  ASSERT_EQ(occluders.edges().size(), 4U);
  const Point centre = Point{0.5, 0.5, 0} - faces.origin;
  for (const OccluderEdge& e : occluders.edges()) {
    const auto ends = occluders.ends(e);
    const auto free = occluders.free_side(e, {0, 0, -1});
    ASSERT_TRUE(free.has_value());
    EXPECT_NEAR(dot(*free, normalized(midpoint(ends[0], ends[1]) - centre)), 1.0, 1e-12);
  }
}

TEST(Silhouettes, PassableFacesCastNoShadow) {
  const Faces faces = faces_from(box());
  const std::vector<std::uint8_t> passable(faces.count(), 1);
  EXPECT_TRUE(Occluders(faces, passable).edges().empty());
}

TEST(Silhouettes, EdgesInLineAreOne) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {"a", "a"});
  support::add_quad(model, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {"b", "b"});
  EXPECT_EQ(Occluders(faces_from(model)).edges().size(), 4U);
}

TEST(Silhouettes, ContourVertexHasRoomForLinesBesideIt) {
  const Faces faces = faces_from(box());
  const Occluders occluders(faces);
  ASSERT_EQ(occluders.vertex_count(), 8U);
  for (std::uint32_t v = 0; v < 8; ++v) {
    const Vector outward = occluders.point(v) - Point{};
    EXPECT_FALSE(occluders.is_contour(v, outward));
    EXPECT_TRUE(occluders.is_contour(v, {outward.x, -outward.y, 0.1}));
  }
}

}  // namespace
}  // namespace clerestory::mesh
