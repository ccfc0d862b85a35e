// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/direct_light.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::ElementId;
using mesh::Point;

/// Direct light of a study, with its solution as it stands after it.
struct Lit : test::Stage {
  explicit Lit(const Study& study, std::uint64_t seed = 1) : Stage(study), importance(solution, walks(1)) {
    NoProgress nobody;
    light = light_directly(solution, importance, 0.002 * 0.02, seed, nobody);
    solution.push_pull();
  }
  /// Area mean of what the elements of a side of a material receive straight [lux].
  [[nodiscard]] double received(const std::string& material, mesh::Side side = mesh::Side::kFront) const {
    double flux = 0.0;
    double area = 0.0;
    for (const ElementId e : solution.elements()) {
      const ElementId top = solution.tree().root(e);
      bool mine = false;
      for (const ElementId root : roots(material, side)) mine = mine || root == top;
      if (!mine) continue;
      flux += solution.tree().area(e) * solution.irradiance(e)[0].value;
      area += solution.tree().area(e);
    }
    return flux / area;
  }
  /// The stated noise of such a mean over the front [lux].
  [[nodiscard]] double noise(const std::string& material) const {
    double squares = 0.0;
    double area = 0.0;
    for (const ElementId e : solution.elements()) {
      if (solution.tree().root(e) != root(material)) continue;
      squares += std::pow(solution.tree().area(e) * solution.noise(e), 2);
      area += solution.tree().area(e);
    }
    return std::sqrt(squares) / area;
  }

  Importance importance;
  DirectLight light;
};

Study under_sky(mesh::Model model, Sky::Type type, const Point& sensor) {
  Study study = test::study_of(std::move(model), 0.2, sensor);
  study.sky.type = type;
  return study;
}

TEST(DirectLight, OpenGroundReceivesTheSkysHorizontalIlluminance) {
  for (const Sky::Type type : {Sky::Type::kUniform, Sky::Type::kCieOvercast}) {
    mesh::Model model;
    support::add_quad(model, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {"ground", "ground"});
    const Lit lit(under_sky(model, type, {1, 1, 0.5}));
    for (const mesh::Side side : {mesh::Side::kFront, mesh::Side::kBack}) {
      const double expected = side == mesh::Side::kFront ? 10'000.0 : 2'000.0;  // the ground beyond reflects 20 %
      const ElementId ground = lit.root("ground", side);
      const double error = std::hypot(lit.solution.noise(ground), lit.solution.misfit(ground));
      EXPECT_NEAR(lit.received("ground", side), expected, 3.0 * error + 1.0);
      EXPECT_LT(error, 0.01 * expected);
    }
  }
}

TEST(DirectLight, FreeWallReceivesItsShareOfSkyAndGround) {
  mesh::Model model;
  support::add_quad(model, {0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}, {"screen", "screen"});
  // Uniform: half of each. Overcast: (3π + 8)/(14π) of the horizontal illuminance, and half of the ground's.
  const double overcast = (3.0 * std::numbers::pi + 8.0) / (14.0 * std::numbers::pi);
  EXPECT_NEAR(Lit(under_sky(model, Sky::Type::kUniform, {1, -1, 1})).received("screen"), 6'000.0, 12.0);
  // Over many seeds: right on the mean, and as unsure as it says.
  constexpr int kSeeds = 100;
  double sum = 0.0;
  double squares = 0.0;
  double stated = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Lit lit(under_sky(model, Sky::Type::kCieOvercast, {1, -1, 1}), seed);
    const double difference = lit.received("screen") - (10'000.0 * overcast + 1'000.0);
    sum += difference;
    squares += difference * difference;
    stated += std::pow(lit.noise("screen"), 2);
    EXPECT_LT(lit.noise("screen"), 15.0);
  }
  const double rms = std::sqrt(squares / kSeeds);
  EXPECT_NEAR(sum / kSeeds, 0.0, 3.0 * rms / std::sqrt(kSeeds));
  EXPECT_NEAR(rms / std::sqrt(stated / kSeeds), 1.0, 0.15);
}

/// A room of 4 m × 4 m × 3 m whose roof is an air polygon, or a pane.
Study open_roof(bool glazed) {
  Study study = under_sky(support::box_room(4, 4, 3), Sky::Type::kUniform, {2, 2, 0.5});
  Material& roof = test::material(study, "ceiling");
  roof.front.reflectance.reset();
  roof.back.reflectance.reset();
  if (glazed) {
    roof.glazing = Glazing{};
  } else {
    roof.opening = true;
  }
  return study;
}

TEST(DirectLight, ThroughAnOpenRoofFollowsTheFormFactor) {
  // A uniform sky makes the opening a lamp of its horizontal illuminance.
  const Lit lit(open_roof(false));
  ASSERT_EQ(lit.scene.openings.size(), 1U);
  EXPECT_NEAR(lit.received("floor"), 10'000.0 * 0.28273279, 10.0);
  EXPECT_NEAR(lit.received("wall"), 10'000.0 * 0.17931680 * 16.0 / 12.0, 10.0);
}

TEST(DirectLight, PaneTakesAwayAtLeastItsNormalShare) {
  const Lit lit(open_roof(true));
  EXPECT_LT(lit.received("floor"), 10'000.0 * 0.28273279 * 0.70);
  EXPECT_GT(lit.received("floor"), 10'000.0 * 0.28273279 * 0.65);
}

TEST(DirectLight, WithoutASkyOpeningsGiveNothing) {
  Study study = open_roof(false);
  study.sky.type = Sky::Type::kNone;
  test::shine(test::material(study, "floor"), 1.0);
  const Lit lit(study);
  EXPECT_EQ(lit.received("wall"), 0.0);
  EXPECT_TRUE(lit.light.links.empty());
}

TEST(DirectLight, WhatStandsBeyondAnOpeningBecomesLinksThatCompleteTheSky) {
  // A hall 100 m wide around the room would be all there is beyond the roof: one screen above it hides the whole sky.
  mesh::Model model = support::box_room(4, 4, 3);
  support::add_quad(model, {-2, -2, 4}, {-2, 4, 4}, {6, 4, 4}, {6, -2, 4}, {"screen", "screen"});
  Study study = under_sky(model, Sky::Type::kUniform, {2, 2, 0.5});
  test::material(study, "ceiling").opening = true;
  const Lit lit(study);
  const ElementId floor = lit.root("floor");
  double links = 0.0;
  for (const Link& link : lit.light.links) {
    if (lit.solution.tree().root(link.receiver) == floor) {
      links += link.factor * lit.solution.tree().area(link.receiver) / 16.0;
    }
  }
  // Sky and what hides it make up the whole opening.
  EXPECT_GT(links, 0.05);
  EXPECT_NEAR(links + lit.received("floor") / 10'000.0, 0.28273279, 3e-3);
}

TEST(DirectLight, LampLightsAClosedRoomWithAllItsFlux) {
  Study study = test::study_of(support::box_room(4, 5, 3), 0.0, {2, 2, 0.5});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({1.3, 2.1, 1.7}, 100.0));
  const Lit lit(study);
  double flux = 0.0;
  for (const ElementId e : lit.solution.elements()) {
    flux += lit.solution.tree().area(e) * lit.solution.irradiance(e)[0].value;
  }
  EXPECT_NEAR(flux, 400.0 * std::numbers::pi, 0.005 * 400.0 * std::numbers::pi);
}

TEST(DirectLight, LampInAClosedRoomLeavesTheOutsideDark) {
  Study study = test::study_of(support::box_room(4, 5, 3), 0.5, {2, 2, 0.5});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({1.3, 2.1, 1.7}, 100.0));
  const Lit lit(study);
  for (const std::string part : {"floor", "wall", "ceiling"}) {
    EXPECT_EQ(lit.received(part, mesh::Side::kBack), 0.0) << part;
  }
}

}  // namespace
}  // namespace clerestory::lighting
