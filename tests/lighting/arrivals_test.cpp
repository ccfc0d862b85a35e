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

  [[nodiscard]] Link link(ElementId receiver, ElementId source, float factor) const {
    Link l;
    l.receiver = receiver;
    l.source = LinkSource::element(source);
    l.factor = factor;
    return l;
  }
};

TEST(Arrivals, OneWayLinksArriveAtTheirReceiverInTheOrderGiven) {
  const TwoSquares squares;
  const std::vector<Link> links{squares.link(squares.upper, squares.lower, 0.1F),
                                squares.link(squares.lower, squares.upper, 0.2F),
                                squares.link(squares.upper, squares.lower, 0.3F)};
  const Arrivals arrivals(links, squares.solution.tree());
  ASSERT_EQ(arrivals.receivers(), 2U);
  std::vector<float> factors;
  arrivals.visit(squares.upper, [&](const Link& l) { factors.push_back(l.factor); });
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
  const Arrivals arrivals(links, squares.solution.tree());
  std::size_t seen = 0;
  arrivals.visit(squares.upper, [&](const Link& back) {
    ++seen;
    EXPECT_EQ(back.receiver, squares.upper);
    EXPECT_EQ(back.source.element(), squares.lower);
    EXPECT_FLOAT_EQ(back.factor, 0.1F) << "of six times the area a sixth";
    EXPECT_FLOAT_EQ(back.moment_u, 0.01F / 6.0F) << "what was the receiver's slope";
    EXPECT_FLOAT_EQ(back.slope_v, 0.02F / 6.0F);
    EXPECT_EQ(back.error, 0.004F);
  });
  EXPECT_EQ(seen, 1U);
}

TEST(Arrivals, NothingArrivesWithoutLinks) {
  const TwoSquares squares;
  const std::vector<Link> none;
  const Arrivals arrivals(none, squares.solution.tree());
  EXPECT_EQ(arrivals.receivers(), 0U);
  arrivals.visit(squares.lower, [](const Link&) { FAIL(); });
}

}  // namespace
}  // namespace clerestory::lighting
