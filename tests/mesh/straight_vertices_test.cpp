// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/straight_vertices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::mesh {
namespace {

using support::faces_of;
using support::unbalanced_edges;

constexpr double kWidth = 4.0;  // metres

/// A room whose floor is so many slivers: strips from wall to wall, each cut along its diagonal; turned about the z axis.
Model room_on_slivers(std::size_t slivers, double turn_rad) {
  const auto turned = [&](double x, double y, double z) {
    return Point{std::cos(turn_rad) * x - std::sin(turn_rad) * y, std::sin(turn_rad) * x + std::cos(turn_rad) * y, z};
  };
  Model room;
  const auto strips = static_cast<double>(slivers / 2);
  for (double i = 0.0; i < strips; i += 1.0) {
    const Point a = turned(kWidth * i / strips, 0, 0);
    const Point b = turned(kWidth * (i + 1.0) / strips, 0, 0);
    const Point c = turned(kWidth * (i + 1.0) / strips, kWidth, 0);
    const Point d = turned(kWidth * i / strips, kWidth, 0);
    support::add_triangle(room, a, b, c, {"floor", "room"});
    support::add_triangle(room, a, c, d, {"floor", "room"});
  }
  const auto corner = [&](int x, int y, int z) { return turned(kWidth * x, kWidth * y, 3.0 * z); };
  const support::Names wall{"wall", "room"};
  support::add_quad(room, corner(0, 0, 0), corner(0, 0, 1), corner(1, 0, 1), corner(1, 0, 0), wall);
  support::add_quad(room, corner(1, 0, 0), corner(1, 0, 1), corner(1, 1, 1), corner(1, 1, 0), wall);
  support::add_quad(room, corner(1, 1, 0), corner(1, 1, 1), corner(0, 1, 1), corner(0, 1, 0), wall);
  support::add_quad(room, corner(0, 1, 0), corner(0, 1, 1), corner(0, 0, 1), corner(0, 0, 0), wall);
  support::add_quad(room, corner(0, 0, 1), corner(0, 1, 1), corner(1, 1, 1), corner(1, 0, 1), wall);
  return room;
}

TEST(StraightVertices, OfSliversAlongWallsAreTakenOut) {
  for (const auto& [slivers, turn_rad] : {std::pair<std::size_t, double>{10'000, 0.0}, {1'000, 0.5}}) {
    const Faces faces = build_faces(clean(room_on_slivers(slivers, turn_rad), {}));
    EXPECT_EQ(faces.count(), 6U);
    EXPECT_EQ(faces.shape.vertices.size(), 8U) << turn_rad;
    EXPECT_EQ(faces.shape.triangles.size(), 12U) << turn_rad;
    EXPECT_EQ(unbalanced_edges(faces, "room"), 0U);
    for (const FaceId floor : faces_of(faces, "floor")) EXPECT_NEAR(faces.faces[floor.index()].area_m2, 16.0, 1e-6);
  }
}

/// Faces with these boundaries round, all in one plane.
FaceDrafts drafts_of(const std::vector<std::vector<Point>>& loops) {
  FaceDrafts drafts(2e-5);
  for (const std::vector<Point>& loop : loops) {
    FaceDraft& face = drafts.faces.emplace_back();
    for (std::size_t i = 0; i < loop.size(); ++i)
      face.boundary.push_back({drafts.vertices.add(loop[i]), drafts.vertices.add(loop[(i + 1) % loop.size()])});
  }
  return drafts;
}

TEST(StraightVertices, StayWhereALineEndsOnThem) {
  // Three squares: the line between the upper two ends in the middle of the lower one's side.
  FaceDrafts drafts = drafts_of({{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}},
                                 {{0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
                                 {{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}});
  drop_straight_vertices(drafts, std::vector<std::uint8_t>(3, 0));
  EXPECT_EQ(drafts.vertices.points().size(), 8U);
  EXPECT_EQ(drafts.faces[0].boundary.size(), 5U);
}

TEST(StraightVertices, OfALineThatEndsNowhereOnlyCornersStay) {
  std::vector<Point> ring;
  for (int i = 0; i < 100; ++i) ring.push_back({0.01 * i, 0, 0});
  ring.insert(ring.end(), {{1, 0, 0}, {1, 1, 0}, {0.5, 1.0 + 1e-7, 0}, {0, 1, 0}});
  FaceDrafts drafts = drafts_of({ring});
  drop_straight_vertices(drafts, std::vector<std::uint8_t>(1, 0));
  EXPECT_EQ(drafts.faces[0].boundary.size(), 4U);
  EXPECT_EQ(drafts.vertices.points().size(), 4U);
}

TEST(StraightVertices, OfAGentleArcAndOfCurvedFacesStay) {
  std::vector<Point> arc;
  for (int i = 0; i <= 90; ++i) arc.push_back({std::cos(i * M_PI / 180), std::sin(i * M_PI / 180), 0});
  arc.push_back({0, 0, 0});
  FaceDrafts drafts = drafts_of({arc});
  drop_straight_vertices(drafts, std::vector<std::uint8_t>(1, 0));
  EXPECT_EQ(drafts.faces[0].boundary.size(), 92U);

  FaceDrafts curved = drafts_of({{{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  drop_straight_vertices(curved, std::vector<std::uint8_t>(1, 1));
  EXPECT_EQ(curved.faces[0].boundary.size(), 4U);
}

}  // namespace
}  // namespace clerestory::mesh
