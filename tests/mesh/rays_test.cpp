// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "mesh/clean.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_checks.h"

namespace clerestory::mesh {
namespace {

constexpr std::int32_t kFirstCurve = 0;

/// Faces of a model with rays against them; places are given in model coordinates.
struct Site {
  explicit Site(const Model& model, const std::vector<std::string>& passable_materials = {})
      : faces(build_faces(clean(model, {}))),
        passable(passable_faces(faces, passable_materials)),
        rays(faces, passable) {}

  static std::vector<std::uint8_t> passable_faces(const Faces& faces, const std::vector<std::string>& materials) {
    std::vector<std::uint8_t> marks(faces.count(), 0);
    for (const std::string& material : materials) {
      for (const FaceId f : support::faces_of(faces, material)) marks[f.index()] = 1;
    }
    return marks;
  }

  [[nodiscard]] Point local(const Point& p) const { return p - faces.origin; }
  [[nodiscard]] Hit hit(const Point& from, const Vector& direction) const {
    return rays.first_hit({local(from), direction});
  }
  [[nodiscard]] float passes(const Point& from, const Point& to) const {
    const Segment segment{local(from), local(to)};
    float passed = -1.0F;
    rays.transmittance({&segment, 1}, {&passed, 1});
    return passed;
  }
  [[nodiscard]] FaceId only(const std::string& material) const { return support::faces_of(faces, material).at(0); }

  /// All passable faces get one curve, as openings to a side where asked.
  void glaze(const TransmittanceCurve& curve, bool opening = false, Side outside = Side::kFront) {
    std::vector<Passage> passages(faces.count());
    for (std::size_t f = 0; f < passages.size(); ++f) {
      if (passable[f] != 0) passages[f] = {.curve = kFirstCurve, .opening = opening, .outside = outside};
    }
    rays.set_passages(passages, {curve});
  }

  Faces faces;
  std::vector<std::uint8_t> passable;
  Rays rays;
};

/// A curve that tells cosines apart: 0.9 cos.
TransmittanceCurve sloping_curve() {
  TransmittanceCurve curve{};
  for (std::size_t i = 0; i < curve.size(); ++i) {
    curve[i] = 0.9F * static_cast<float>(i) / static_cast<float>(curve.size() - 1);
  }
  return curve;
}

/// A pane of 2 m × 2 m at z = 0, front up, in the middle of four opaque strips that keep the model's box wide.
Model pane_in_frame() {
  Model model = support::square_with_hole();
  support::add_quad(model, {1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}, {"glass", "pane"});
  return model;
}

TEST(TransmittanceCurve, IsInterpolatedLinearlyAndKeepsItsEnds) {
  TransmittanceCurve curve{};
  for (std::size_t i = 0; i < curve.size(); ++i) curve[i] = static_cast<float>(i * i);
  EXPECT_FLOAT_EQ(transmittance_at(curve, 0.0F), 0.0F);
  EXPECT_FLOAT_EQ(transmittance_at(curve, 1.0F), 128.0F * 128.0F);
  EXPECT_FLOAT_EQ(transmittance_at(curve, 10.5F / 128.0F), 0.5F * (100.0F + 121.0F));
}

TEST(Rays, FirstHitNamesFaceSideAndDistance) {
  const Site site(support::facing_squares(1.0));
  const Hit from_above = site.hit({0.3, 0.4, 0.75}, {0, 0, -1});
  EXPECT_EQ(from_above.face, site.only("lower"));
  EXPECT_EQ(from_above.side, Side::kFront);
  EXPECT_NEAR(from_above.distance, 0.75, 1e-12);
  const Hit from_below = site.hit({0.3, 0.4, -2.0}, {0, 0, 1});
  EXPECT_EQ(from_below.face, site.only("lower"));
  EXPECT_EQ(from_below.side, Side::kBack);
  EXPECT_NEAR(from_below.distance, 2.0, 1e-12);
}

TEST(Rays, DistanceIsInUnitsOfTheDirection) {
  const Site site(support::facing_squares(1.0));
  EXPECT_NEAR(site.hit({0.3, 0.4, 0.75}, {0, 0, -0.25}).distance, 3.0, 1e-12);
}

TEST(Rays, HitTriangleHoldsTheHitPoint) {
  const Site site(support::l_room());
  const Point from{0.7, 0.9, 1.4};
  for (int i = 0; i < 100; ++i) {
    const Vector d{std::cos(2.4 * i), std::sin(2.4 * i), std::cos(0.7 * i)};
    const Hit hit = site.hit(from, d);
    ASSERT_TRUE(hit.face.valid());
    const Triangle& t = site.faces.shape.triangles.at(hit.triangle);
    const Point at = site.local(from) + hit.distance * d;
    const Vector& normal = site.faces.faces[hit.face.index()].frame.w;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& a = site.faces.shape.vertices[t.vertices[k]];
      const Point& b = site.faces.shape.vertices[t.vertices[(k + 1) % 3]];
      EXPECT_GE(dot(cross(b - a, at - a), normal), -1e-5);
    }
  }
}

TEST(Rays, NothingIsHitBeyondTheModel) {
  const Site site(support::facing_squares(1.0));
  EXPECT_FALSE(site.hit({0.5, 0.5, 1.5}, {0, 0, 1}).face.valid());
  EXPECT_FALSE(site.hit({0.5, 0.5, 0.5}, {1, 0, 0}).face.valid());
}

TEST(Rays, NoRayLeavesAClosedRoom) {
  const Site site(support::rotated(support::l_room(), {0.48, -0.6, 0.64}, 0.7));
  const Point inside = site.faces.shape.vertices[0];
  Box box;
  for (const Point& p : site.faces.shape.vertices) box.add(p);
  // One of the legs of the L, near the corner of the floor, whatever the rotation did to it.
  const Point from = inside + 0.2 * (box.centre() - inside);
  for (int i = 0; i < 20'000; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / 20'000;
    const double r = std::sqrt(1.0 - z * z);
    ASSERT_TRUE(site.rays.first_hit({from, {r * std::cos(2.399963 * i), r * std::sin(2.399963 * i), z}}).face.valid())
        << i;
  }
}

TEST(Rays, EdgesAndVerticesOfTheTriangulationAreTight) {
  const Site site(support::box_room(4, 4, 3));
  for (const Triangle& t : site.faces.shape.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& a = site.faces.shape.vertices[t.vertices[k]];
      const Point& b = site.faces.shape.vertices[t.vertices[(k + 1) % 3]];
      for (const double x : {0.0, 0.25, 0.5}) {
        const Point target = a + x * (b - a);
        EXPECT_TRUE(site.rays.first_hit({{0.1, -0.2, 0.3}, target - Point{0.1, -0.2, 0.3}}).face.valid());
      }
    }
  }
}

TEST(Rays, OpaqueFacesBlockASegmentThatCrossesThem) {
  const Site site(support::facing_squares(1.0));
  EXPECT_EQ(site.passes({0.5, 0.5, -0.5}, {0.5, 0.5, 0.5}), 0.0F);
  EXPECT_EQ(site.passes({0.5, 0.5, 0.1}, {0.2, 0.8, 0.9}), 1.0F);
  EXPECT_EQ(site.passes({1.5, 0.5, -0.5}, {1.5, 0.5, 0.5}), 1.0F);
}

TEST(Rays, SegmentEndsBeforeWhatLiesBeyond) {
  const Site site(support::facing_squares(1.0));
  EXPECT_EQ(site.passes({0.5, 0.5, 0.5}, {0.5, 0.5, 0.999}), 1.0F);
  EXPECT_EQ(site.passes({0.5, 0.5, 0.5}, {0.5, 0.5, 1.001}), 0.0F);
}

TEST(Rays, PassableFacesAreClearUntilTold) {
  const Site site(pane_in_frame(), {"glass"});
  EXPECT_EQ(site.passes({1.7, 1.6, -1}, {1.7, 1.6, 1}), 1.0F);
  EXPECT_EQ(site.passes({0.5, 0.5, -1}, {0.5, 0.5, 1}), 0.0F);
}

TEST(Rays, OnePaneTransmitsByItsCurveAtTheAngleOfIncidence) {
  Site site(pane_in_frame(), {"glass"});
  site.glaze(sloping_curve());
  EXPECT_NEAR(site.passes({1.7, 1.6, -1}, {1.7, 1.6, 1}), 0.9, 1e-6);
  // A slope of 3 : 4 gives a cosine of 0.8, from either side and whatever the length.
  EXPECT_NEAR(site.passes({1.1, 1.6, -0.4}, {1.7, 1.6, 0.4}), 0.72, 1e-6);
  EXPECT_NEAR(site.passes({2.0, 2.9, 0.4}, {2.0, 2.3, -0.4}), 0.72, 1e-6);
}

TEST(Rays, PaneOfTwoTrianglesCountsOnceOnItsDiagonal) {
  Site site(pane_in_frame(), {"glass"});
  site.glaze(sloping_curve());
  ASSERT_EQ(site.faces.shape.of(site.only("glass")).size(), 2U);
  for (const double x : {1.25, 1.5, 1.9, 2.0, 2.3, 2.75}) {
    EXPECT_NEAR(site.passes({x, x, -1}, {x, x, 1}), 0.9, 1e-6) << x;
    EXPECT_NEAR(site.passes({x, 4.0 - x, -1}, {x, 4.0 - x, 1}), 0.9, 1e-6) << x;
  }
}

TEST(Rays, PanesInSeriesMultiply) {
  Model model = pane_in_frame();
  support::add_quad(model, {1, 1, 0.5}, {3, 1, 0.5}, {3, 3, 0.5}, {1, 3, 0.5}, {"glass", "second"});
  Site site(model, {"glass"});
  site.glaze(sloping_curve());
  EXPECT_NEAR(site.passes({1.7, 1.6, -1}, {1.7, 1.6, 1}), 0.81, 1e-6);
  EXPECT_NEAR(site.passes({2, 2, -1}, {2, 2, 1}), 0.81, 1e-6) << "on both diagonals";
}

TEST(Rays, OpaqueBehindGlassStillBlocks) {
  Model model = pane_in_frame();
  support::add_quad(model, {1, 1, 0.5}, {3, 1, 0.5}, {3, 3, 0.5}, {1, 3, 0.5}, {"wall", "wall"});
  Site site(model, {"glass"});
  site.glaze(sloping_curve());
  EXPECT_EQ(site.passes({1.7, 1.6, -1}, {1.7, 1.6, 1}), 0.0F);
}

TEST(Rays, SegmentsStopWhereTheyLeaveThroughASampledOpening) {
  Site site(pane_in_frame(), {"glass"});
  ASSERT_NEAR(site.faces.faces[site.only("glass").index()].frame.w.z, 1.0, 1e-12);
  site.glaze(sloping_curve(), true, Side::kFront);
  EXPECT_EQ(site.passes({1.7, 1.6, -1}, {1.7, 1.6, 1}), 0.0F) << "outwards";
  EXPECT_NEAR(site.passes({1.7, 1.6, 1}, {1.7, 1.6, -1}), 0.9, 1e-6) << "inwards";
  site.glaze(sloping_curve(), true, Side::kBack);
  EXPECT_NEAR(site.passes({1.7, 1.6, -1}, {1.7, 1.6, 1}), 0.9, 1e-6) << "inwards";
  EXPECT_EQ(site.passes({1.7, 1.6, 1}, {1.7, 1.6, -1}), 0.0F) << "outwards";
}

TEST(Rays, FirstHitSeesGlassToo) {
  const Site site(pane_in_frame(), {"glass"});
  EXPECT_EQ(site.hit({1.7, 1.6, 1}, {0, 0, -1}).face, site.only("glass"));
}

TEST(Rays, FarFromTheOriginTheLiftStaysSmallBecauseFacesAreRecentred) {
  const Vector shift{612'345.123456, 5'412'345.654321, 520.25};
  const Site near_by(support::box_room(6, 8, 3));
  const Site far_off(support::moved(support::box_room(6, 8, 3), shift));
  EXPECT_DOUBLE_EQ(near_by.rays.offset_m(), 1e-5);
  EXPECT_DOUBLE_EQ(far_off.rays.offset_m(), 1e-5);
  const Hit hit = far_off.hit(Point{2, 3, 1} + shift, {0, 0, -1});
  EXPECT_NEAR(hit.distance, 1.0, 1e-8);
}

TEST(Rays, LiftGrowsWithTheExtentOfLargeModels) {
  Model model = support::facing_squares(1.0);
  support::add_quad(model, {4000, 0, 0}, {4001, 0, 0}, {4001, 1, 0}, {4000, 1, 0});
  const Site site(model);
  const double ulp = std::nextafter(2000.0F, 1e9F) - 2000.0F;
  EXPECT_GE(site.rays.offset_m(), 2.0 * ulp);
  EXPECT_LE(site.rays.offset_m(), 8.0 * ulp);
}

TEST(Rays, EveryRayIsCounted) {
  const Site site(support::facing_squares(1.0));
  const std::uint64_t before = site.rays.use().rays;
  std::ignore = site.hit({0.5, 0.5, 0.5}, {0, 0, 1});
  std::ignore = site.passes({0.5, 0.5, 0.5}, {0.5, 0.5, 0.6});
  EXPECT_EQ(site.rays.use().rays, before + 2);
}

TEST(Rays, BoundsAreThoseOfTheFaces) {
  const Site site(support::box_room(6, 8, 3));
  EXPECT_NEAR(site.rays.bounds().size().x, 6.0, 1e-12);
  EXPECT_NEAR(site.rays.bounds().size().y, 8.0, 1e-12);
  EXPECT_NEAR(site.rays.bounds().size().z, 3.0, 1e-12);
}

TEST(Rays, TellWhatTheyCost) {
  const Site site(support::box_room(4, 4, 3));
  std::vector<Segment> segments(1000, Segment{{1, 1, 1}, {2, 2, 1}});
  std::vector<float> passed(segments.size());
  EXPECT_EQ(site.rays.use().seconds, 0.0);
  for (int i = 0; i < 640; ++i) site.rays.transmittance(segments, passed);
  EXPECT_EQ(site.rays.use().rays, 640'000U);
  // Far from what they take on any machine, and not zero.
  EXPECT_GT(site.rays.use().seconds, 640'000 * 1e-9);
  EXPECT_LT(site.rays.use().seconds, 640'000 * 1e-5);
}

}  // namespace
}  // namespace clerestory::mesh
