// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/linker.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

#include "lighting/form_factor.h"
#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::ElementId;
using mesh::Visibility;
using Kind = LinkDecision::Kind;

constexpr double kStrict_lux = 1e-9;  ///< so that every link is measured, none is rough
constexpr double kLenient_lux = 1e9;

/// All that a linker needs, over surfaces that shine on both sides.
struct Pairs : test::Stage {
  explicit Pairs(const Study& study)
      : Stage(study), importance(solution, {}), clusters((solution.push_pull(), scene), solution.tree()) {
    clusters.pull(solution);
  }
  [[nodiscard]] LinkDecision decide(ElementId receiver, LinkSource source, double tolerance_lux = kStrict_lux) const {
    return Linker(solution, clusters, channels, importance, tolerance_lux, 1)
        .decide({receiver, source, Visibility::kPartial});
  }
  [[nodiscard]] Link link(ElementId receiver, ElementId source) const {
    return decide(receiver, LinkSource::element(source)).link;
  }
  /// What both directions of a link exchange [m²].
  [[nodiscard]] double exchange(ElementId receiver, ElementId source) const {
    return solution.tree().area(receiver) * link(receiver, source).factor;
  }

  Importance importance;
  Clusters clusters;
  ChannelDeviations channels;
};

Study shining(mesh::Model model) {
  Study study = test::study_of(std::move(model), 0.5, {0, 0, 0});
  study.grids.clear();
  for (Material& m : study.materials) {
    m.front.emission = m.back.emission = Emission{.flux_lm = {}, .luminance_cd_m2 = 100.0};
  }
  return study;
}

/// A unit square under one of 2 m × 3 m at 1.5 m, with something between.
mesh::Model unequal_squares(const mesh::Model& between = {}) {
  mesh::Model model;
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {"lower", "lower"});
  support::add_quad(model, {0, 0, 1.5}, {0, 3, 1.5}, {2, 3, 1.5}, {2, 0, 1.5}, {"upper", "upper"});
  support::append(model, between);
  return model;
}

mesh::Model screen(double to_x) {
  mesh::Model model;
  support::add_quad(model, {-5, -5, 0.7}, {to_x, -5, 0.7}, {to_x, 5, 0.7}, {-5, 5, 0.7}, {"screen", "screen"});
  return model;
}

TEST(Linker, ProvenViewHasTheExactFormFactor) {
  const Pairs pairs(shining(support::facing_squares(1.0)));
  const Link link = pairs.link(pairs.root("lower"), pairs.root("upper"));
  EXPECT_EQ(link.visibility, Visibility::kVisible);
  EXPECT_NEAR(link.factor, 0.19982490, 1e-5);
  EXPECT_NEAR(link.slope_u, 0.0, 2e-3) << "symmetric";
  EXPECT_NEAR(link.slope_v, 0.0, 2e-3);
}

TEST(Linker, MutualLinkIsTheSameSeenFromEitherEnd) {
  const Pairs pairs(shining(unequal_squares()));
  const ElementId a = pairs.root("lower");
  const ElementId b = pairs.root("upper");
  const Linker linker(pairs.solution, pairs.clusters, pairs.channels, pairs.importance, kLenient_lux, 1);
  ASSERT_EQ(linker.prove(a, b), Visibility::kVisible);
  const Link there = linker.link({a, LinkSource::element(b), Visibility::kVisible, true}).value();
  const Link back =
      reversed(linker.link({b, LinkSource::element(a), Visibility::kVisible, true}).value(), pairs.solution.tree());
  EXPECT_TRUE(there.mutual);
  EXPECT_FLOAT_EQ(there.factor, back.factor);
  EXPECT_FLOAT_EQ(there.slope_u, back.slope_u);
  EXPECT_FLOAT_EQ(there.moment_v, back.moment_v);
  EXPECT_FLOAT_EQ(there.error, back.error);
  EXPECT_GT(there.back_error, 0.0F);
}

TEST(Linker, MutualLinkIsRefinedForTheEndThatAsksForIt) {
  const Pairs pairs(shining(unequal_squares()));
  const ElementId a = pairs.root("lower");
  const ElementId b = pairs.root("upper");
  const Link link = Linker(pairs.solution, pairs.clusters, pairs.channels, pairs.importance, kLenient_lux, 1)
                        .link({a, LinkSource::element(b), Visibility::kVisible, true})
                        .value();
  Link one_way = link;
  one_way.mutual = false;
  // The larger receiver tolerates less, by its area, and its places miss more.
  const double between = 0.5 * (link.error + link.back_error) * 100.0 * 3.141592653589793;
  const Linker linker(pairs.solution, pairs.clusters, pairs.channels, pairs.importance,
                      between * 0.5 * pairs.importance.of(pairs.solution.tree(), a), 1);
  EXPECT_TRUE(linker.holds(one_way));
  EXPECT_FALSE(linker.holds(link));
  EXPECT_EQ(linker.split_of(link), Kind::kSplitSource);
}

TEST(Linker, WhatIsEvenInAllLightIsRefinedWhereAChannelIsNot) {
  Pairs pairs(shining(unequal_squares()));
  const ElementId a = pairs.root("lower");
  const ElementId b = pairs.root("upper");
  const double tolerance =
      2.0 * pairs.link(a, b).error * pairs.solution.radiosity_mean(b) * pairs.importance.of(pairs.solution.tree(), a);
  const auto holds = [&] {
    return Linker(pairs.solution, pairs.clusters, pairs.channels, pairs.importance, tolerance, 1)
        .holds(pairs.link(a, b));
  };
  EXPECT_TRUE(holds());
  pairs.channels.nodes.assign(pairs.solution.tree().size(), 0.0F);
  pairs.channels.nodes[b.index()] = 0.5F * pairs.solution.radiosity_mean(b);
  EXPECT_FALSE(holds());
}

TEST(Linker, OpenEndsShareNoMoreThanIsAllowedOfWhatALineMisses) {
  Pairs pairs(shining(unequal_squares()));
  const ElementId a = pairs.root("lower");
  const ElementId b = pairs.root("upper");
  const Linker linker(pairs.solution, pairs.clusters, pairs.channels, pairs.importance, kLenient_lux, 1);
  const Link link = linker.link({a, LinkSource::element(b), Visibility::kVisible, true}).value();
  EXPECT_EQ(linker.split_at_open_ends(link, 0.0), Kind::kLink) << "neither is open";
  pairs.solution.open(b);
  EXPECT_EQ(linker.split_at_open_ends(link, 0.0), Kind::kSplitSource);
  EXPECT_EQ(linker.split_at_open_ends(link, 1.0), Kind::kLink);
}

TEST(Linker, ProvenViewsAreReciprocal) {
  const Pairs pairs(shining(unequal_squares()));
  const ElementId a = pairs.root("lower");
  const ElementId b = pairs.root("upper");
  EXPECT_NEAR(pairs.exchange(a, b), pairs.exchange(b, a), 1e-6 * pairs.exchange(a, b));
}

TEST(Linker, SampledViewsOfUnequalPiecesAreReciprocal) {
  for (const double x : {0.2, 0.5, 0.8, 1.1}) {
    const Pairs pairs(shining(unequal_squares(screen(x))));
    const ElementId a = pairs.root("lower");
    const ElementId b = pairs.root("upper");
    ASSERT_EQ(pairs.link(a, b).visibility, Visibility::kPartial);
    EXPECT_NEAR(pairs.exchange(a, b), pairs.exchange(b, a), 1e-3 * pairs.exchange(a, b)) << x;
  }
}

/// What passes beside a screen that ends at x, by brute force: the mean over the lower square of what it sees of the upper one
/// beyond the screen's edge, whose projection from each point cuts the upper square along a line of constant x.
double beside_screen(double x) {
  constexpr int kSteps = 64;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const mesh::Point p{(i + 0.5) / kSteps, (j + 0.5) / kSteps, 0.0};
      const double from = std::max(0.0, p.x + (x - p.x) * 1.5 / 0.7);
      if (from >= 2.0) continue;
      const std::array<mesh::Point, 4> c{{{from, 0, 1.5}, {from, 3, 1.5}, {2, 3, 1.5}, {2, 0, 1.5}}};
      const std::array<mesh::OutlineEdge, 4> seen{{{c[0], c[1]}, {c[1], c[2]}, {c[2], c[3]}, {c[3], c[0]}}};
      sum += point_form_factor(p, {0, 0, 1}, seen, {0, 0, -1}) / (kSteps * kSteps);
    }
  }
  return sum;
}

TEST(Linker, SampledViewsLieWithinTheirErrorOfTheTruth) {
  // Over many screens: at most a few outside of twice the error, none of three times.
  int outside = 0;
  constexpr int kScreens = 24;
  for (int i = 0; i < kScreens; ++i) {
    const double x = 0.1 + 0.045 * i;
    const Pairs pairs(shining(unequal_squares(screen(x))));
    const Link link = pairs.link(pairs.root("lower"), pairs.root("upper"));
    const double z = std::abs(link.factor - beside_screen(x)) / link.error;
    EXPECT_LT(z, 3.0) << x;
    outside += z > 2.0 ? 1 : 0;
  }
  EXPECT_LE(outside, 3);
}

TEST(Linker, HiddenPairsGetNoLink) {
  const Pairs pairs(shining(unequal_squares(screen(5.0))));
  EXPECT_EQ(pairs.decide(pairs.root("lower"), LinkSource::element(pairs.root("upper"))).kind, Kind::kNone);
}

TEST(Linker, PiecesOfOnePlaneAndPiecesThatLookAwayGetNoLink) {
  mesh::Model model = support::facing_squares(1.0);
  support::add_quad(model, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0}, {"beside", "beside"});
  const Pairs pairs(shining(model));
  const LinkSource lower = LinkSource::element(pairs.root("lower"));
  EXPECT_EQ(pairs.decide(pairs.root("beside"), lower).kind, Kind::kNone);
  EXPECT_EQ(pairs.decide(pairs.root("upper", mesh::Side::kBack), lower).kind, Kind::kNone);
  EXPECT_EQ(pairs.decide(pairs.root("lower"), lower).kind, Kind::kNone) << "itself";
}

TEST(Linker, GlassBetweenWeakensTheLink) {
  mesh::Model pane;
  support::add_quad(pane, {-5, -5, 0.7}, {5, -5, 0.7}, {5, 5, 0.7}, {-5, 5, 0.7}, {"glass", "pane"});
  Study study = shining(unequal_squares(pane));
  Material& glass = test::material(study, "glass");
  glass.front = glass.back = {};
  glass.glazing = Glazing{};
  const Pairs behind(study);
  const Pairs clear(shining(unequal_squares()));
  const double share = behind.link(behind.root("lower"), behind.root("upper")).factor /
                       clear.link(clear.root("lower"), clear.root("upper")).factor;
  EXPECT_LT(share, 0.70);
  EXPECT_GT(share, 0.65);
}

TEST(Linker, ErrorOverTheToleranceSplitsTheLargerSide) {
  const Pairs pairs(shining(unequal_squares(screen(0.5))));
  const ElementId lower = pairs.root("lower");
  const ElementId upper = pairs.root("upper");
  EXPECT_EQ(pairs.decide(lower, LinkSource::element(upper)).kind, Kind::kSplitSource);
  EXPECT_EQ(pairs.decide(upper, LinkSource::element(lower)).kind, Kind::kSplitReceiver);
  EXPECT_EQ(pairs.decide(lower, LinkSource::element(upper), kLenient_lux).kind, Kind::kLink);
}

TEST(Linker, LinksThatCannotMatterAreRightOnTheAverage) {
  // A source far off, behind a screen with a gap: the mean over many seeds of one rough link is the measured factor.
  mesh::Model model;
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {"lower", "lower"});
  support::add_quad(model, {0, 0, 8}, {0, 1, 8}, {1, 1, 8}, {1, 0, 8}, {"upper", "upper"});
  support::add_quad(model, {-5, -5, 4}, {0.4, -5, 4}, {0.4, 5, 4}, {-5, 5, 4}, {"screen", "screen"});
  const Pairs pairs(shining(model));
  const LinkCandidate candidate{pairs.root("lower"), LinkSource::element(pairs.root("upper")), Visibility::kPartial};
  constexpr int kSeeds = 2000;
  double mean = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Linker linker(pairs.solution, pairs.clusters, pairs.channels, pairs.importance, kLenient_lux, seed);
    const LinkDecision decision = linker.decide(candidate);
    ASSERT_EQ(decision.kind, Kind::kLink);
    ASSERT_TRUE(decision.link.rough);
    mean += decision.link.factor / kSeeds;
  }
  // Uniform x on both squares; (x1 + x2)/2 > 0.4 has the probability 1 − 0.8²/2.
  const double unoccluded = 1.0 / (64.0 * std::acos(-1.0));
  EXPECT_NEAR(mean / unoccluded, 0.68, 0.03);
}

TEST(Linker, ClusterThatSurroundsItsReceiverIsOpened) {
  const Pairs pairs(shining(support::box_room(4, 5, 3)));
  EXPECT_EQ(pairs.decide(pairs.root("floor"), LinkSource::cluster(0), kLenient_lux).kind, Kind::kSplitSource);
}

/// Roots of a cluster.
std::vector<ElementId> members(const Clusters& clusters, std::uint32_t c) {
  if (clusters.is_leaf(c)) return {clusters.root(c)};
  std::vector<ElementId> found = members(clusters, clusters.left(c));
  for (const ElementId e : members(clusters, clusters.right(c))) found.push_back(e);
  return found;
}

/// The whole light of a globe's facets at a square, and what links give that hold at a tolerance: as they were judged, and as they stay.
struct KeptLight {
  double all = 0.0;
  double judged = 0.0;
  double stays = 0.0;
  int links = 0;
  int unseen = 0;
};

/// Refines clusters to the links that hold; elements are measured strictly.
void add_kept(const Pairs& pairs, const Linker& linker, ElementId receiver, std::uint32_t c, KeptLight& kept) {
  if (pairs.clusters.is_leaf(c)) {
    const ElementId source = pairs.clusters.root(c);
    const LinkDecision decision = linker.decide({receiver, LinkSource::element(source), Visibility::kPartial});
    if (decision.kind == Kind::kNone) return;
    kept.judged += decision.link.factor;
    kept.stays += decision.link.factor;
    return;
  }
  const LinkDecision decision = linker.decide({receiver, LinkSource::cluster(c), Visibility::kPartial});
  if (decision.kind == Kind::kLink) {
    ++kept.links;
    kept.judged += decision.link.factor;
    const std::optional<Link> link = linker.remeasured(decision.link);
    kept.stays += link ? link->factor : 0.0;
    if (link && link->factor <= 0.0F) {
      ++kept.unseen;
      EXPECT_EQ(link->error, decision.link.error) << "points that see nothing tell nothing";
    }
  } else if (decision.kind != Kind::kNone) {
    add_kept(pairs, linker, receiver, pairs.clusters.left(c), kept);
    add_kept(pairs, linker, receiver, pairs.clusters.right(c), kept);
  }
}

TEST(Linker, ClustersThatAreKeptGiveAllOfTheirLight) {
  mesh::Model model;
  support::add_quad(model, {-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}, {"lower", "lower"});
  support::add_globe(model, {0.7, 0.4, 2}, 0.3, 24, 12, {"globe", "globe"});
  const Pairs pairs(shining(std::move(model)));
  const ElementId lower = pairs.root("lower");
  KeptLight light;
  for (const ElementId e : pairs.roots("globe")) light.all += pairs.link(lower, e).factor;
  // What a cluster may be wrong by where its points differ as much as these facets do.
  const double tolerance = 0.002 * 100.0 * std::acos(-1.0) * pairs.importance.of(pairs.solution.tree(), lower);
  constexpr int kSeeds = 1000;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Linker linker(pairs.solution, pairs.clusters, pairs.channels, pairs.importance, tolerance, seed);
    add_kept(pairs, linker, lower, 0, light);
  }
  EXPECT_GT(light.links, 2 * kSeeds);
  EXPECT_GT(light.unseen, 0);
  EXPECT_NEAR(light.stays / kSeeds, light.all, 0.01 * light.all);
  EXPECT_LT(light.judged / kSeeds, 0.97 * light.all) << "or this test tells nothing";
}

TEST(Linker, FacetGivesAllOfItsLightToAWallMostlyBehindIt) {
  // The facet's plane leaves a strip of the wall in front of it; a speck before the strip leaves the view unproven.
  constexpr double kPlane_m = 1.7;
  mesh::Model model;
  support::add_quad(model, {0, -1, 0}, {2, -1, 0}, {2, 1, 0}, {0, 1, 0}, {"wall", "wall"});
  support::add_quad(model, {kPlane_m, -0.1, 6.0}, {kPlane_m, 0.1, 6.0}, {kPlane_m, 0.1, 6.2}, {kPlane_m, -0.1, 6.2},
                    {"facet", "facet"});
  support::add_quad(model, {1.8, 0, 3}, {1.8, 0, 3.01}, {1.8, 0.01, 3.01}, {1.8, 0.01, 3}, {"speck", "speck"});
  const Pairs pairs(shining(std::move(model)));
  const ElementId wall = pairs.root("wall");
  const ElementId facet = pairs.root("facet");
  const Link link = pairs.link(wall, facet);
  ASSERT_EQ(link.visibility, Visibility::kPartial);
  std::array<mesh::OutlineEdge, 3> scratch;
  double expected = 0.0;
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const mesh::Point p{kPlane_m, -0.1 + 0.2 * (i % kSteps + 0.5) / kSteps, 6.0 + 0.2 * (i / kSteps + 0.5) / kSteps};
    expected += point_form_factor(pairs.local(p), {1, 0, 0}, pairs.solution.tree().outline(wall, scratch), {0, 0, 1}) /
                (kSteps * kSteps);
  }
  expected *= pairs.solution.tree().area(facet);
  EXPECT_NEAR(link.factor * pairs.solution.tree().area(wall), expected, 0.01 * expected);
}

TEST(Linker, FarClusterLooksLikeTheSumOfItsParts) {
  mesh::Model model;
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {"lower", "lower"});
  support::add_box(model, {-0.5, -0.5, 6}, {0.5, 0.5, 7}, {"box", "box"});
  const Pairs pairs(shining(model));
  const ElementId lower = pairs.root("lower");
  int clusters = 0;
  for (std::uint32_t c = 0; c < pairs.clusters.size(); ++c) {
    if (pairs.clusters.is_leaf(c) || pairs.clusters.box(c).low.z < pairs.solution.tree().centroid(lower).z + 1.0) {
      continue;
    }
    double parts = 0.0;
    for (const ElementId e : members(pairs.clusters, c)) parts += pairs.link(lower, e).factor;
    const LinkDecision decision = pairs.decide(lower, LinkSource::cluster(c));
    EXPECT_NEAR(decision.link.factor, parts, 3.0 * decision.link.error) << c;
    ++clusters;
  }
  EXPECT_GT(clusters, 3);
}

}  // namespace
}  // namespace clerestory::lighting
