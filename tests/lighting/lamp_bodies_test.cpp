// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/lamp_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

const Point kGlobe{0, 0, 2};
constexpr double kRadius_m = 0.2;
constexpr int kMeridians = 16;
constexpr int kParallels = 8;

/// A floor below a globe, with a plate between that covers x > 1, and more.
struct GlobeOverFloor : test::Stage {
  static Study study(const mesh::Model& more) {
    mesh::Model model;
    support::add_quad(model, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, {"floor", "floor"});
    support::add_quad(model, {0.5, -2, 1}, {2, -2, 1}, {2, 2, 1}, {0.5, 2, 1}, {"plate", "plate"});
    support::add_globe(model, kGlobe, kRadius_m, kMeridians, kParallels, {"lamp", "globe"});
    support::append(model, more);
    Study study = test::study_of(std::move(model), 0.0, {0, 0, 0.5});
    test::shine(test::material(study, "lamp"), 1000.0);
    return study;
  }
  explicit GlobeOverFloor(const mesh::Model& more = {})
      : Stage(study(more)), lamps(emitters(solution)), bodies(solution, lamps) {}

  [[nodiscard]] BodySight sight(const Point& from) const {
    return bodies.sight(solution, bodies.bodies()[0], {.corners = {local(from)}, .count = 1, .normal = {}});
  }
  /// From a square of 20 cm on the floor.
  [[nodiscard]] BodySight sight_of_square(double x, double y) const {
    const Point c = local({x, y, 1e-4});
    return bodies.sight(solution, bodies.bodies()[0],
                        {.corners = {c, c + Vector{0.2, 0, 0}, c + Vector{0.2, 0.2, 0}, c + Vector{0, 0.2, 0}},
                         .count = 4,
                         .normal = {0, 0, 1}});
  }

  std::vector<Emitter> lamps;
  LampBodies bodies;
};

TEST(LampBodies, FacetsThatHangTogetherAreOneBodyAndFewAreNone) {
  mesh::Model panel;
  support::add_quad(panel, {2, 2, 2.5}, {2, 2.5, 2.5}, {2.5, 2.5, 2.5}, {2.5, 2, 2.5}, {"lamp", "panel"});
  const GlobeOverFloor site(panel);
  ASSERT_EQ(site.bodies.bodies().size(), 1U);
  const LampBody& globe = site.bodies.bodies()[0];
  EXPECT_EQ(globe.facets.size(), std::size_t{kMeridians} * kParallels);
  EXPECT_TRUE(globe.convex);
  ASSERT_EQ(site.bodies.others().size(), 1U);
  EXPECT_NEAR(site.solution.tree().area(site.lamps[site.bodies.others()[0]].root), 0.25, 1e-9) << "the panel";
  double area = 0.0;
  for (const BodyFacet& facet : globe.facets) {
    area += facet.area_m2;
    EXPECT_GT(dot(facet.centre - site.local(kGlobe), facet.normal), 0.0) << "outwards";
  }
  EXPECT_NEAR(area, 4.0 * std::acos(-1.0) * kRadius_m * kRadius_m, 0.05 * area);
}

TEST(LampBodies, TwoThatDoNotTouchAreTwo) {
  mesh::Model other;
  support::add_globe(other, {-1, 1, 2}, 0.1, kMeridians, kParallels, {"lamp", "other"});
  const GlobeOverFloor site(other);
  ASSERT_EQ(site.bodies.bodies().size(), 2U);
  EXPECT_TRUE(site.bodies.bodies()[1].convex);
}

TEST(LampBodies, IsNotConvexWithAnythingElseInItsBox) {
  mesh::Model rod;  // its end in a corner of the box, beside the globe
  support::add_box(rod, {0.17, 0.17, 2.15}, {0.19, 0.19, 2.6}, {"rod", "rod"});
  EXPECT_FALSE(GlobeOverFloor(rod).bodies.bodies()[0].convex);
}

TEST(LampBodies, ABowlIsNotConvex) {
  // The lower half of a globe that shines to the inside too.
  mesh::Model bowl;
  const auto at = [&](int m, int p) {
    const double azimuth = 2.0 * std::acos(-1.0) * (m % 16) / 16.0;
    const double polar = std::acos(-1.0) * (0.5 + 0.1 * p);
    return Point{-2 + 0.3 * std::sin(polar) * std::cos(azimuth), 0.3 * std::sin(polar) * std::sin(azimuth),
                 2 + 0.3 * std::cos(polar)};
  };
  for (int p = 0; p < 4; ++p) {
    for (int m = 0; m < 16; ++m)
      support::add_quad(bowl, at(m + 1, p), at(m + 1, p + 1), at(m, p + 1), at(m, p), {"lamp", "bowl"});
  }
  const GlobeOverFloor site(bowl);
  ASSERT_EQ(site.bodies.bodies().size(), 2U);
  EXPECT_FALSE(site.bodies.bodies()[1].convex);
}

TEST(LampBodies, SightIsProvenFromTheOpenAndFromTheUmbra) {
  const GlobeOverFloor site;
  EXPECT_EQ(site.sight({-1, 0.3, 0.01}), BodySight::kClear);
  EXPECT_EQ(site.sight({1.6, 0, 0.01}), BodySight::kHidden);
  // The plate's edge at x = 0.5 throws the middle of its penumbra to x = 1.
  EXPECT_EQ(site.sight({1.0, 0, 0.01}), BodySight::kPartial);
  EXPECT_EQ(site.sight(kGlobe), BodySight::kPartial) << "from within";
  EXPECT_EQ(site.sight_of_square(-1, 0), BodySight::kClear);
  EXPECT_EQ(site.sight_of_square(1.5, 0), BodySight::kHidden);
  EXPECT_EQ(site.sight_of_square(0.9, 0), BodySight::kPartial);
}

TEST(LampBodies, WhatIsClearIsSeenByEveryRay) {
  const GlobeOverFloor site;
  const LampBody& globe = site.bodies.bodies()[0];
  int clear = 0;
  for (double x = -2.9; x < 2.9; x += 0.2) {
    for (double y = -2.9; y < 2.9; y += 0.4) {
      const Point from = site.local({x, y, 0.01});
      if (site.sight({x, y, 0.01}) != BodySight::kClear) continue;
      ++clear;
      for (const BodyFacet& facet : globe.facets) {
        if (dot(from - facet.centre, facet.normal) <= 1e-3) continue;
        const mesh::Segment ray{from, facet.centre + site.scene.rays->offset_m() * facet.normal};
        float passed = 0.0F;
        site.scene.rays->transmittance({&ray, 1}, {&passed, 1});
        ASSERT_EQ(passed, 1.0F) << x << " " << y;
      }
    }
  }
  EXPECT_GT(clear, 200);
}

TEST(LampBodies, MiddlesStandForFarFacetsToAThousandth) {
  const GlobeOverFloor site;
  for (const Point& p : {Point{0, 0, 0}, Point{-2.5, 1, 0}, Point{0.1, 0.05, 1.7}}) {
    double sum = 0.0;
    double exact = 0.0;
    for (const BodyFacet& facet : site.bodies.bodies()[0].facets) {
      sum += full_factor(site.solution, site.lamps, facet, site.local(p), Vector{0, 0, 1});
      exact += full_factor(site.solution, site.lamps[facet.emitter], site.local(p), Vector{0, 0, 1});
    }
    EXPECT_GT(exact, 0.0);
    EXPECT_NEAR(sum, exact, 1e-3 * exact) << p.z;
  }
}

}  // namespace
}  // namespace clerestory::lighting
