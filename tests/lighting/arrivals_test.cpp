// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/arrivals.h"

#include <gtest/gtest.h>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::ElementId;

/// A unit square under one of 2 m × 3 m.
mesh::Model unequal_squares() {
  mesh::Model model;
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {"lower", "lower"});
  support::add_quad(model, {0, 0, 1.5}, {0, 3, 1.5}, {2, 3, 1.5}, {2, 0, 1.5}, {"upper", "upper"});
  return model;
}

struct TwoSquares : test::Stage {
  TwoSquares() : Stage(test::study_of(unequal_squares(), 0.5, {0.5, 0.5, 1})) {}

  ElementId lower = root("lower");
  ElementId upper = root("upper");

  [[nodiscard]] static Link link(ElementId receiver, LinkSource source, float factor) {
    Link l;
    l.receiver = receiver;
    l.source = source;
    l.factor = factor;
    return l;
  }
  [[nodiscard]] static Link link(ElementId receiver, ElementId source, float factor) {
    return link(receiver, LinkSource::element(source), factor);
  }
};

TEST(Arrivals, OneWayLinksArriveAtTheirReceiverInTheOrderGiven) {
  const TwoSquares squares;
  const std::vector<Link> first{squares.link(squares.upper, squares.lower, 0.1F),
                                squares.link(squares.lower, squares.upper, 0.2F)};
  const std::vector<Link> second{squares.link(squares.upper, squares.lower, 0.3F)};
  const Arrivals arrivals({first, second}, squares.solution.tree(), false);
  ASSERT_EQ(arrivals.receivers(), 2U);
  EXPECT_EQ(arrivals.count(), 3U);
  std::vector<float> factors;
  for (const Arrival& a : arrivals.at(squares.upper)) factors.push_back(a.factor());
  EXPECT_EQ(factors, (std::vector<float>{0.1F, 0.3F}));
}

TEST(Arrivals, MutualLinksArriveAtBothEndsAndExchangeTheSame) {
  const TwoSquares squares;
  Link l = squares.link(squares.lower, squares.upper, 0.6F);
  l.slope_u = 0.01F;
  l.moment_v = 0.02F;
  l.error = 0.003F;
  l.back_error = 0.004F;
  l.mutual = true;
  const std::vector<Link> links{l};
  const Arrivals arrivals({links}, squares.solution.tree(), true);
  ASSERT_EQ(arrivals.at(squares.upper).size(), 1U);
  const Arrival back = arrivals.at(squares.upper)[0];
  EXPECT_EQ(back.source().element(), squares.lower);
  EXPECT_TRUE(back.is_mutual() && back.is_back() && back.is_proven());
  EXPECT_FALSE(arrivals.at(squares.lower)[0].is_back());
  EXPECT_FLOAT_EQ(back.factor(), 0.1F) << "of six times the area a sixth";
  EXPECT_NEAR(back.moment_u(), 0.01F / 6.0F, 1e-6) << "what was the receiver's slope";
  EXPECT_NEAR(back.slope_v(), 0.02F / 6.0F, 1e-6);
  const std::size_t upper = arrivals.receiver(0) == squares.upper ? 0 : 1;
  EXPECT_EQ(arrivals.errors_at(upper)[0].error, 0.004F);
}

TEST(Arrivals, LinksComeBackAsTheyWereButForTheRoundingOfTheirSlopes) {
  const TwoSquares squares;
  Link l = squares.link(squares.lower, squares.upper, 0.25F);
  l.slope_u = -0.011F;
  l.moment_v = 0.07F;
  l.error = 0.003F;
  l.noise = 0.002F;
  l.rough = true;
  l.split_small = true;
  const std::vector<Link> links{l};
  const Link same = Arrivals({links}, squares.solution.tree(), true).link(0, 0);
  EXPECT_EQ(same.receiver, l.receiver);
  EXPECT_EQ(same.source, l.source);
  EXPECT_EQ(same.factor, l.factor);
  EXPECT_NEAR(same.slope_u, l.slope_u, 0.011 / 2048.0);
  EXPECT_NEAR(same.moment_v, l.moment_v, 0.07 / 2048.0);
  EXPECT_EQ(same.error, l.error);
  EXPECT_EQ(same.noise, l.noise);
  EXPECT_TRUE(same.rough && same.split_small);
  EXPECT_FALSE(same.mutual || same.by_rays);
  EXPECT_EQ(same.visibility, mesh::Visibility::kPartial);
}

TEST(Arrivals, NothingArrivesWithoutLinks) {
  const TwoSquares squares;
  const Arrivals arrivals({}, squares.solution.tree(), true);
  EXPECT_EQ(arrivals.receivers(), 0U);
  EXPECT_TRUE(arrivals.at(squares.lower).empty());
  EXPECT_TRUE(arrivals.has_errors());
}

TEST(Arrivals, TakeLittleMoreThan16BytesALink) {
  const TwoSquares squares;
  const std::vector<Link> links(1000, squares.link(squares.lower, squares.upper, 0.1F));
  Arrivals arrivals({links}, squares.solution.tree(), true);
  arrivals.forget_errors();
  EXPECT_FALSE(arrivals.has_errors());
  EXPECT_LE(arrivals.bytes(), 16'100U);
}

TEST(Arrivals, ComeBackFromTheirWords) {
  const TwoSquares squares;
  Link l = squares.link(squares.lower, LinkSource::cluster(7), 0.3F);
  l.slope_v = 0.2F;
  const Arrival arrival(l, false);
  const auto back = Arrival::of_words(arrival.words());
  ASSERT_TRUE(back);
  EXPECT_EQ(back->source(), l.source);
  EXPECT_EQ(back->factor(), arrival.factor());
  EXPECT_EQ(back->slopes(), arrival.slopes());
  EXPECT_FALSE(Arrival::of_words({0x70000001U, 0, 0, 0})) << "made in no way that there is";
  EXPECT_FALSE(Arrival::of_words({1, 0x7FC00000U, 0, 0})) << "a factor that is no number";
  EXPECT_FALSE(Arrival::of_words({1, 0xBF800000U, 0, 0})) << "a factor below zero";
}

}  // namespace
}  // namespace clerestory::lighting
