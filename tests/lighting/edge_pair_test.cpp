// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/edge_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace clerestory::lighting {
namespace {

using mesh::OutlineEdge;
using mesh::Point;
using mesh::Vector;

Point along(const OutlineEdge& e, double share) { return e.from + share * (e.to - e.from); }

/// By the midpoint rule: its error falls with the square of the number of points where the edges keep apart.
double by_points(const OutlineEdge& p, const OutlineEdge& q, int n) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) sum += std::log(norm(along(p, (i + 0.5) / n) - along(q, (j + 0.5) / n)));
  }
  return sum / n / n * dot(p.to - p.from, q.to - q.from);
}

/// A thousand pairs, from far apart to nearly crossing; one in five shares a corner, one in five is nearly parallel. Checks get what a value may be
/// wrong by.
template <class Check>
void for_random_pairs(const Check& check) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  const auto vector = [&] { return Vector{coordinate(generator), coordinate(generator), coordinate(generator)}; };
  for (int i = 0; i < 1000; ++i) {
    const double apart = std::exp(3.0 * coordinate(generator));
    OutlineEdge p{Point{} + vector(), Point{} + vector()};
    OutlineEdge q{Point{} + (apart * vector() + vector()), Point{}};
    q.to = q.from + std::exp(coordinate(generator)) * vector();
    if (i % 5 == 1) q.from = p.to;
    if (i % 5 == 2)
      q.to = q.from + (p.to - p.from) + std::pow(10.0, -2.0 - 6.0 * std::abs(coordinate(generator))) * vector();
    SCOPED_TRACE(testing::Message() << "pair " << i);
    check(p, q, (i % 5 == 2 ? 1e-5 : 1e-7) * norm(p.to - p.from) * norm(q.to - q.from));
  }
}

TEST(EdgePair, AnEdgeWithItselfIsKnown) {
  for (const double length : {0.3, 1.0, 2.0}) {
    const OutlineEdge edge{{0.1, 0.2, 0.3}, {0.1, 0.2 + length, 0.3}};
    const double expected = length * length * (std::log(length) - 1.5);
    EXPECT_NEAR(edge_pair_integral(edge, edge), expected, 1e-13);
    EXPECT_NEAR(edge_pair_integral(edge, {edge.to, edge.from}), -expected, 1e-13);
  }
}

TEST(EdgePair, EdgesOfASquaresCornerExchangeNothing) {
  EXPECT_EQ(edge_pair_integral({{0, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {1, 1, 0}}), 0.0);
}

TEST(EdgePair, EdgesFromACornerAreWhatEulersTheoremGives) {
  // Two unit edges at 60 degrees: 2 ∬ ln r = 2 ∫ ln |e_p − t e_q| dt − 1, and |e_p − t e_q|² = (t − 1/2)² + 3/4.
  const OutlineEdge p{{0, 0, 0}, {1, 0, 0}};
  const OutlineEdge q{{0, 0, 0}, {0.5, std::sqrt(0.75), 0}};
  const double line = 0.5 * std::log(1.0) - 1.0 + std::sqrt(0.75) * 2.0 * std::atan(0.5 / std::sqrt(0.75));
  EXPECT_NEAR(edge_pair_integral(p, q), 0.5 * (line - 0.5), 1e-14);
}

TEST(EdgePair, SkewEdgesAreWhatManyPointsGive) {
  const OutlineEdge p{{-0.4, 0, 0}, {0.7, 0, 0}};
  for (const double height : {0.03, 0.1, 0.4, 1.0, 3.0}) {
    const OutlineEdge q{{-0.5, -0.6, height}, {0.8, 0.9, height + 0.1}};
    EXPECT_NEAR(edge_pair_integral(p, q), by_points(p, q, 1200), 2e-6) << height;
  }
}

TEST(EdgePair, PartsOfAnEdgeAddUpToIt) {
  for_random_pairs([](const OutlineEdge& p, const OutlineEdge& q, double close) {
    const Point cut = along(q, 0.37);
    EXPECT_NEAR(edge_pair_integral(p, q), edge_pair_integral(p, {q.from, cut}) + edge_pair_integral(p, {cut, q.to}),
                20.0 * close);
  });
}

TEST(EdgePair, IsTheSameFromEitherEdgeAndEnd) {
  for_random_pairs([](const OutlineEdge& p, const OutlineEdge& q, double close) {
    EXPECT_NEAR(edge_pair_integral(p, q), edge_pair_integral(q, p), close);
    EXPECT_NEAR(edge_pair_integral(p, q), -edge_pair_integral({p.to, p.from}, q), close);
  });
}

}  // namespace
}  // namespace clerestory::lighting
