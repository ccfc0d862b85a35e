// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/shafts.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <random>
#include <vector>

#include "mesh/clean.h"
#include "mesh/rays.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::mesh {
namespace {

ShaftEnd end(std::initializer_list<Point> corners) {
  ShaftEnd e;
  for (const Point& p : corners) e.corners[e.count++] = p;
  if (e.count >= 3) e.normal = normalized(cross(e.corners[1] - e.corners[0], e.corners[2] - e.corners[0]));
  return e;
}

/// Shafts among the faces of a model; ends are given in model coordinates.
struct Site {
  explicit Site(const Model& model, const std::string& passable_material = {})
      : faces(build_faces(clean(model, {}))),
        passable(passable_faces(faces, passable_material)),
        shafts(faces, passable) {}

  static std::vector<std::uint8_t> passable_faces(const Faces& faces, const std::string& material) {
    std::vector<std::uint8_t> marks(faces.count(), 0);
    if (material.empty()) return marks;
    for (const FaceId f : support::faces_of(faces, material)) marks[f.index()] = 1;
    return marks;
  }
  /// The same whichever end comes first, or the test fails.
  [[nodiscard]] Visibility classify(ShaftEnd a, ShaftEnd b) const {
    for (ShaftEnd* e : {&a, &b}) {
      for (std::size_t i = 0; i < e->count; ++i) e->corners[i] = e->corners[i] - faces.origin;
    }
    const Visibility seen = shafts.classify(a, b);
    EXPECT_EQ(seen, shafts.classify(b, a));
    return seen;
  }

  Faces faces;
  std::vector<std::uint8_t> passable;
  Shafts shafts;
};

const ShaftEnd kLower = end({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
const ShaftEnd kUpper = end({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}});

/// Facing unit squares with something between or around them.
Model squares_and(const Model& more) {
  Model model = support::facing_squares(1.0);
  support::append(model, more);
  return model;
}

Model quad(const Point& a, const Point& b, const Point& c, const Point& d, const std::string& material = "wall") {
  Model model;
  support::add_quad(model, a, b, c, d, {material, "between"});
  return model;
}

TEST(Shafts, NothingBetweenIsProvenVisible) {
  EXPECT_EQ(Site(support::facing_squares(1.0)).classify(kLower, kUpper), Visibility::kVisible);
}

TEST(Shafts, OneConvexWallThatCoversTheShaftHides) {
  const Site site(squares_and(quad({-0.5, -0.5, 0.5}, {1.5, -0.5, 0.5}, {1.5, 1.5, 0.5}, {-0.5, 1.5, 0.5})));
  EXPECT_EQ(site.classify(kLower, kUpper), Visibility::kHidden);
}

TEST(Shafts, FaceDoesNotBlockItsOwnPieces) {
  // As where corners of a polygon lie off the plane that its pieces lie in.
  const Site site(support::facing_squares(1.0));
  ShaftEnd upper = kUpper;
  for (std::size_t i = 0; i < upper.count; ++i) upper.corners[i] = upper.corners[i] + Vector{0, 0, 1e-6};
  EXPECT_NE(site.classify(kLower, upper), Visibility::kVisible);
  upper.face = support::faces_of(site.faces, "upper").front();
  EXPECT_EQ(site.classify(kLower, upper), Visibility::kVisible);
}

TEST(Shafts, WallThatLeavesASlitIsPartial) {
  const Site site(squares_and(quad({0.001, -0.5, 0.5}, {1.5, -0.5, 0.5}, {1.5, 1.5, 0.5}, {0.001, 1.5, 0.5})));
  EXPECT_EQ(site.classify(kLower, kUpper), Visibility::kPartial);
}

TEST(Shafts, ThinDeskLegBetweenIsPartial) {
  Model leg;
  support::add_box(leg, {0.5, 0.5, 0.3}, {0.505, 0.505, 0.6}, {"metal", "leg"});
  EXPECT_EQ(Site(squares_and(leg)).classify(kLower, kUpper), Visibility::kPartial);
}

TEST(Shafts, ObjectBesideTheShaftLeavesItVisible) {
  Model leg;
  support::add_box(leg, {1.02, 0.4, 0.3}, {1.3, 0.6, 0.6}, {"metal", "leg"});
  EXPECT_EQ(Site(squares_and(leg)).classify(kLower, kUpper), Visibility::kVisible);
}

TEST(Shafts, PlateBesideTheShaftThatNoPlaneOfEitherPartsFromItLeavesItVisible) {
  // A leaning shaft past the edge of a level plate: its box ends before the plate.
  const Site site(quad({0.5, -2, 1}, {2, -2, 1}, {2, 2, 1}, {0.5, 2, 1}));
  EXPECT_EQ(site.classify(end({{-1, 0.3, 0.01}}),
                          end({{-0.2, 0.2, 1.8}, {-0.2, 0.2, 2.2}, {0.2, 0.2, 2.2}, {0.2, 0.2, 1.8}})),
            Visibility::kVisible);
}

TEST(Shafts, LouvreIsPartialThoughAllItsSlatsTogetherHide) {
  // Slats at 45 degrees that overlap as seen from below: no single one covers.
  Model slats;
  for (double x = -1.0; x < 2.0; x += 0.1) {
    support::add_quad(slats, {x, -1, 0.4}, {x + 0.2, -1, 0.6}, {x + 0.2, 2, 0.6}, {x, 2, 0.4}, {"metal", "louvre"});
  }
  EXPECT_EQ(Site(squares_and(slats)).classify(kLower, kUpper), Visibility::kPartial);
}

TEST(Shafts, ThinWallBetweenRoomsHides) {
  const Site site(support::two_rooms_with_thin_wall());
  const ShaftEnd floor_left = end({{1, 1, 0}, {2.9, 1, 0}, {2.9, 3, 0}, {1, 3, 0}});
  const ShaftEnd ceiling_right = end({{3.1, 1, 3}, {3.1, 3, 3}, {5, 3, 3}, {5, 1, 3}});
  EXPECT_EQ(site.classify(floor_left, ceiling_right), Visibility::kHidden);
}

TEST(Shafts, PiecesThatTouchAThinWallAreNeverProvenVisibleThroughIt) {
  const Site site(support::two_rooms_with_thin_wall());
  const ShaftEnd floor_left = end({{2, 1, 0}, {3, 1, 0}, {3, 3, 0}, {2, 3, 0}});
  const ShaftEnd ceiling_right = end({{3, 1, 3}, {3, 3, 3}, {4, 3, 3}, {4, 1, 3}});
  EXPECT_NE(site.classify(floor_left, ceiling_right), Visibility::kVisible);
}

TEST(Shafts, NeighboursAcrossAnEdgeAreVisible) {
  const Site site(support::box_room(4, 4, 3));
  const ShaftEnd floor = end({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  const ShaftEnd wall = end({{4, 0, 0}, {0, 0, 0}, {0, 0, 3}, {4, 0, 3}});
  EXPECT_EQ(site.classify(floor, wall), Visibility::kVisible);
}

TEST(Shafts, SurfacesInThePlaneOfAnEndDoNotBlock) {
  // A board in the plane of the lower square, beside it and over its edge; and one behind it.
  const Site site(squares_and(quad({-1, 0.2, 0}, {0.4, 0.2, 0}, {0.4, 0.8, 0}, {-1, 0.8, 0})));
  EXPECT_EQ(site.classify(kLower, kUpper), Visibility::kVisible);
  const Site below(squares_and(quad({-1, -1, -0.01}, {2, -1, -0.01}, {2, 2, -0.01}, {-1, 2, -0.01})));
  EXPECT_EQ(below.classify(kLower, kUpper), Visibility::kVisible);
}

TEST(Shafts, PaneMakesPartialNeverHidden) {
  const Model pane = quad({-0.5, -0.5, 0.5}, {1.5, -0.5, 0.5}, {1.5, 1.5, 0.5}, {-0.5, 1.5, 0.5}, "glass");
  EXPECT_EQ(Site(squares_and(pane), "glass").classify(kLower, kUpper), Visibility::kPartial);
}

TEST(Shafts, PointIsAnEndToo) {
  const ShaftEnd point = end({{0.5, 0.5, 0}});
  const Model wall = quad({0.2, 0.2, 0.5}, {0.8, 0.2, 0.5}, {0.8, 0.8, 0.5}, {0.2, 0.8, 0.5});
  EXPECT_EQ(Site(squares_and({})).classify(point, kUpper), Visibility::kVisible);
  EXPECT_EQ(Site(squares_and(wall)).classify(point, kUpper), Visibility::kHidden);
  EXPECT_EQ(Site(squares_and(wall)).classify(kLower, kUpper), Visibility::kPartial);
}

TEST(Shafts, BlockersAreWholeConvexFacesUnlessPanesOrTooMany) {
  Model model = support::facing_squares(1.0);
  support::add_quad(model, {-1, -1, 0.5}, {0.5, -1, 0.5}, {0.5, 2, 0.5}, {-1, 2, 0.5}, {"plate", "plate"});
  support::add_quad(model, {2, 2, 0.5}, {3, 2, 0.5}, {3, 3, 0.5}, {2, 3, 0.5}, {"plate", "beside"});
  const Site site(model);
  ShaftEnd lower = kLower;
  ShaftEnd upper = kUpper;
  for (ShaftEnd* e : {&lower, &upper}) {
    for (std::size_t i = 0; i < e->count; ++i) e->corners[i] = e->corners[i] - site.faces.origin;
  }
  const auto blockers = site.shafts.blockers(lower, upper, 1);
  EXPECT_TRUE(blockers.all);
  ASSERT_EQ(blockers.polygons.size(), 1U);
  EXPECT_EQ(blockers.polygons.front().size(), 4U);
  EXPECT_FALSE(site.shafts.blockers(lower, upper, 0).all);
  const Site paned(model, "plate");
  EXPECT_FALSE(paned.shafts.blockers(lower, upper, 1).all);
  EXPECT_TRUE(paned.shafts.blockers(lower, upper, 1).polygons.empty());
}

TEST(Shafts, IsClearOfAllButOneGroup) {
  Model model = support::facing_squares(1.0);
  support::add_box(model, {0.4, 0.4, 0.4}, {0.5, 0.5, 0.5}, {"lamp", "box"});
  const Site site(model);
  std::vector<std::uint32_t> group(site.faces.count(), 0);
  for (const FaceId f : support::faces_of(site.faces, "lamp")) group[f.index()] = 7;
  ShaftEnd lower = kLower;
  ShaftEnd upper = kUpper;
  for (ShaftEnd* e : {&lower, &upper}) {
    for (std::size_t i = 0; i < e->count; ++i) e->corners[i] = e->corners[i] - site.faces.origin;
  }
  EXPECT_TRUE(site.shafts.is_clear(lower, upper, group, 7));
  EXPECT_FALSE(site.shafts.is_clear(lower, upper, group, 0));
  const auto box = [&](double low, double high) {
    return Box{Point{low, low, low} - site.faces.origin, Point{high, high, high} - site.faces.origin};
  };
  EXPECT_TRUE(site.shafts.is_clear(box(0.3, 0.6), group, 7));
  EXPECT_FALSE(site.shafts.is_clear(box(0.3, 0.6), group, 0));
  EXPECT_FALSE(site.shafts.is_clear(box(0.3, 1.1), group, 7)) << "the upper square";
  EXPECT_TRUE(site.shafts.is_clear(box(0.6, 0.7), group, 0)) << "empty";
  Shafts unproven(site.faces, {});
  unproven.prove_nothing();
  EXPECT_FALSE(unproven.is_clear(lower, upper, group, 7));
  EXPECT_FALSE(unproven.is_clear(box(0.6, 0.7), group, 0));
}

TEST(Shafts, NoFacesHideNothing) {
  const Faces none;
  EXPECT_EQ(Shafts(none, {}).classify(kLower, kUpper), Visibility::kVisible);
}

/// Triangles of about a quarter metre, anywhere in a cube of 2 m.
std::array<Point, 3> random_triangle(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const Point centre{place(random), place(random), place(random)};
  std::array<Point, 3> corners;
  for (Point& c : corners) c = centre + size * Vector{place(random), place(random), place(random)};
  return corners;
}

/// How many of some random segments between two triangles pass.
int passing(const Rays& rays, const ShaftEnd& a, const ShaftEnd& b, std::mt19937& random, int count) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto place = [&](const ShaftEnd& e) {
    double u = uniform(random);
    double v = uniform(random);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    return e.corners[0] + (u * (e.corners[1] - e.corners[0]) + v * (e.corners[2] - e.corners[0])) + 1e-4 * e.normal;
  };
  int sum = 0;
  for (int i = 0; i < count; ++i) {
    const Segment segment{place(a), place(b)};
    float passed = 0.0F;
    rays.transmittance({&segment, 1}, {&passed, 1});
    sum += passed > 0.0F ? 1 : 0;
  }
  return sum;
}

TEST(Shafts, WhatIsProvenHoldsForEveryRay) {
  std::mt19937 random(11);
  Model model;
  for (int i = 0; i < 24; ++i) {
    const auto c = random_triangle(random, i % 3 == 0 ? 0.8 : 0.2);
    support::add_triangle(model, c[0], c[1], c[2]);
  }
  const Site site(model);
  const Rays rays(site.faces);
  int visible = 0;
  int hidden = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto ca = random_triangle(random, 0.1);
    const auto cb = random_triangle(random, 0.1);
    ShaftEnd a = end({ca[0], ca[1], ca[2]});
    ShaftEnd b = end({cb[0], cb[1], cb[2]});
    const auto in_front = [](const ShaftEnd& of, const ShaftEnd& other) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (dot(other.corners[k] - of.corners[0], of.normal) < 1e-3) return false;
      }
      return true;
    };
    if (!in_front(a, b) || !in_front(b, a)) continue;
    const Visibility seen = site.shafts.classify(a, b);
    if (seen == Visibility::kPartial) continue;
    ++(seen == Visibility::kVisible ? visible : hidden);
    EXPECT_EQ(passing(rays, a, b, random, 50), seen == Visibility::kVisible ? 50 : 0) << i;
  }
  EXPECT_GT(visible, 100);
  EXPECT_GT(hidden, 20);
}

}  // namespace
}  // namespace clerestory::mesh
