// SPDX-License-Identifier: GPL-3.0-or-later
// Values are closed forms of Howell's catalogue (C-11, C-14, C-16, C-41), computed to eight digits.
#include "lighting/form_factor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace clerestory::lighting {
namespace {

using mesh::OutlineEdge;
using mesh::Point;
using mesh::Vector;
using std::numbers::pi;

/// A planar polygon, counter-clockwise seen from its side.
struct Polygon {
  std::vector<Point> corners;

  [[nodiscard]] std::vector<OutlineEdge> outline() const {
    std::vector<OutlineEdge> edges;
    for (std::size_t i = 0; i < corners.size(); ++i) edges.push_back({corners[i], corners[(i + 1) % corners.size()]});
    return edges;
  }
  [[nodiscard]] Vector area_vector() const {
    Vector sum;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      sum = sum + 0.5 * cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    }
    return sum;
  }
  [[nodiscard]] double area() const { return norm(area_vector()); }
  [[nodiscard]] Vector normal() const { return normalized(area_vector()); }
};

double form_factor(const Polygon& receiver, const Polygon& source) {
  return exchange_area(receiver.outline(), source.outline()) / receiver.area();
}

double seen(const Point& at, const Vector& normal, const Polygon& source) {
  return point_form_factor(at, normal, source.outline(), source.normal());
}

/// Mean of the point form factor over a parallelogram. The substitution x = s³(10 − 15s + 6s²) makes the midpoint rule good to
/// six digits although the factor has kinks at edges that touch.
double integrated_form_factor(const Polygon& receiver, const Polygon& source) {
  constexpr int kSteps = 96;
  const auto place = [](int i) {
    const double s = (i + 0.5) / kSteps;
    return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
  };
  const auto weight = [](int i) {
    const double s = (i + 0.5) / kSteps;
    return 30.0 * s * s * (1.0 - s) * (1.0 - s) / kSteps;
  };
  const Vector u = receiver.corners[1] - receiver.corners[0];
  const Vector v = receiver.corners[3] - receiver.corners[0];
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Point at = receiver.corners[0] + (place(i) * u + place(j) * v);
      sum += weight(i) * weight(j) * seen(at, receiver.normal(), source);
    }
  }
  return sum;
}

void expect_both_ways(const Polygon& receiver, const Polygon& source, double expected) {
  EXPECT_NEAR(form_factor(receiver, source), expected, 1e-4 * expected);
  EXPECT_NEAR(integrated_form_factor(receiver, source), expected, 5e-6 * expected);
}

Polygon rectangle_up(double a, double b) { return {{{0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0}}}; }
Polygon rectangle_down(double a, double b, double height) {
  return {{{0, 0, height}, {0, b, height}, {a, b, height}, {a, 0, height}}};
}

TEST(FormFactor, FacingRectanglesMatchTheCatalogue) {
  struct Case {
    double a, b, c, expected;
  };
  for (const Case& k : {Case{1, 1, 1, 0.19982490}, Case{1, 1, 2, 0.06858959}, Case{1, 1, 0.5, 0.41525328},
                        Case{2, 1, 1, 0.28587538}, Case{4, 4, 3, 0.28273279}, Case{1, 1, 0.1, 0.82699452}}) {
    SCOPED_TRACE(testing::Message() << k.a << " x " << k.b << " at " << k.c);
    expect_both_ways(rectangle_up(k.a, k.b), rectangle_down(k.a, k.b, k.c), k.expected);
  }
}

TEST(FormFactor, IntegralOverALongStripMatchesTheCatalogue) {
  EXPECT_NEAR(integrated_form_factor(rectangle_up(10, 1), rectangle_down(10, 1, 1)), 0.38638249, 1e-6);
}

TEST(FormFactor, PerpendicularRectanglesWithACommonEdgeMatchTheCatalogue) {
  struct Case {
    double l, w, h, expected;
  };
  for (const Case& k :
       {Case{1, 1, 1, 0.20004378}, Case{1, 1, 2, 0.23285260}, Case{1, 2, 1, 0.11642630}, Case{4, 4, 3, 0.17931680}}) {
    SCOPED_TRACE(testing::Message() << k.l << " x " << k.w << " to " << k.l << " x " << k.h);
    const Polygon wall{{{0, 0, 0}, {0, k.l, 0}, {0, k.l, k.h}, {0, 0, k.h}}};
    expect_both_ways(rectangle_up(k.w, k.l), wall, k.expected);
  }
}

TEST(FormFactor, HingedUnitSquaresMatchTheCatalogueAtAnyAngle) {
  struct Case {
    double degrees, expected;
  };
  for (const Case& k : {Case{30, 0.6190296}, Case{45, 0.4833484}, Case{60, 0.3709058}, Case{90, 0.2000438},
                        Case{120, 0.0866151}, Case{135, 0.0483095}, Case{150, 0.0213453}}) {
    SCOPED_TRACE(k.degrees);
    const double c = std::cos(k.degrees * pi / 180.0);
    const double s = std::sin(k.degrees * pi / 180.0);
    const Polygon leaf{{{0, 0, 0}, {0, 1, 0}, {c, 1, s}, {c, 0, s}}};
    expect_both_ways(rectangle_up(1, 1), leaf, k.expected);
  }
}

/// A regular polygon of the area of a disc.
Polygon disc(double radius, double height, bool up) {
  constexpr int kCorners = 256;
  const double step = 2.0 * pi / kCorners;
  const double r = radius * std::sqrt(step / std::sin(step));
  Polygon polygon;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = (up ? 1.0 : -1.0) * step * i;
    polygon.corners.push_back({r * std::cos(angle), r * std::sin(angle), height});
  }
  return polygon;
}

TEST(FormFactor, CoaxialDiscsMatchTheCatalogue) {
  EXPECT_NEAR(form_factor(disc(1, 0, true), disc(1, 1, false)), 0.38196601, 1e-5);
  EXPECT_NEAR(form_factor(disc(1, 0, true), disc(2, 1, false)), 0.76393202, 1e-5);
  EXPECT_NEAR(form_factor(disc(1, 0, true), disc(0.5, 1, false)), 0.11721778, 1e-5);
}

TEST(FormFactor, SkewTrianglesMatchSchroederAndHanrahan) {
  const Polygon lower{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const Polygon upper{{{.2, .1, 1}, {.3, 1.2, 1.2}, {1.3, .4, 1.5}}};
  EXPECT_NEAR(form_factor(lower, upper), 0.08229963942, 1e-5);
}

TEST(FormFactor, IsReciprocal) {
  const Polygon lower{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const Polygon upper{{{.2, .1, 1}, {.3, 1.2, 1.2}, {1.3, .4, 1.5}}};
  EXPECT_NEAR(exchange_area(lower.outline(), upper.outline()), exchange_area(upper.outline(), lower.outline()), 1e-12);
}

TEST(FormFactor, OfAWholeIsTheSumOfItsParts) {
  const Polygon receiver = rectangle_up(4, 4);
  double parts = 0.0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const double x = i;
      const double y = j;
      const Polygon left{{{x, y, 3}, {x, y + 1, 3}, {x + 1, y + 1, 3}}};
      const Polygon right{{{x, y, 3}, {x + 1, y + 1, 3}, {x + 1, y, 3}}};
      parts += form_factor(receiver, left) + form_factor(receiver, right);
    }
  }
  EXPECT_NEAR(parts, 0.28273279, 1e-6);
}

TEST(PointFormFactor, UnderTheCentreOfAUnitSquareMatchesTheCatalogue) {
  EXPECT_NEAR(seen({0.5, 0.5, 0}, {0, 0, 1}, rectangle_down(1, 1, 1)), 0.23945647, 1e-8);
}

TEST(PointFormFactor, OverAnInfinitePlaneIsHalfOnesTilt) {
  const Polygon plane{{{-1e6, -1e6, 0}, {1e6, -1e6, 0}, {1e6, 1e6, 0}, {-1e6, 1e6, 0}}};
  for (const double degrees : {0.0, 30.0, 60.0, 90.0, 120.0, 179.0}) {
    const double angle = degrees * pi / 180.0;  // of the normal from straight down
    const double expected = 0.5 * (1.0 + std::cos(angle));
    EXPECT_NEAR(seen({0, 0, 1}, {std::sin(angle), 0, -std::cos(angle)}, plane), expected, 2e-6) << degrees;
  }
}

TEST(PointFormFactor, BehindOrInThePlaneSeesNothing) {
  EXPECT_EQ(seen({0.5, 0.5, 2}, {0, 0, -1}, rectangle_down(1, 1, 1)), 0.0) << "behind the source";
  EXPECT_EQ(seen({0.5, 0.5, 0}, {0, 0, -1}, rectangle_down(1, 1, 1)), 0.0) << "behind the point";
  EXPECT_EQ(seen({3, 0.5, 1}, {-1, 0, 0}, rectangle_down(1, 1, 1)), 0.0) << "in its plane";
}

TEST(PointFormFactor, OfNothingIsZero) { EXPECT_EQ(point_form_factor({}, {0, 0, 1}, {}, {0, 0, -1}), 0.0); }

/// The six sides of the box [0, 4] × [0, 5] × [0, 3], facing inwards.
std::vector<Polygon> box_sides() {
  const double x = 4;
  const double y = 5;
  const double z = 3;
  return {{{{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}}}, {{{0, 0, z}, {0, y, z}, {x, y, z}, {x, 0, z}}},
          {{{0, 0, 0}, {0, 0, z}, {x, 0, z}, {x, 0, 0}}}, {{{0, y, 0}, {x, y, 0}, {x, y, z}, {0, y, z}}},
          {{{0, 0, 0}, {0, y, 0}, {0, y, z}, {0, 0, z}}}, {{{x, 0, 0}, {x, 0, z}, {x, y, z}, {x, y, 0}}}};
}

double closure(const Point& at, const Vector& normal) {
  double sum = 0.0;
  for (const Polygon& side : box_sides()) sum += seen(at, normal, side);
  return sum;
}

TEST(PointFormFactor, ABoxFillsTheHemisphereOfAnyPointAndTilt) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> gauss;
  for (int i = 0; i < 5000; ++i) {
    const Point at{4 * uniform(random), 5 * uniform(random), 3 * uniform(random)};
    const Vector normal = normalized(Vector{gauss(random), gauss(random), gauss(random)});
    ASSERT_NEAR(closure(at, normal), 1.0, 1e-12) << i;
  }
}

TEST(PointFormFactor, ABoxFillsTheHemisphereThoughCornersAndEdgesLieOnTheHorizon) {
  const Point centre{2, 2.5, 1.5};
  for (const Vector& n : {Vector{1, 0, 0},
                          {0, 1, 0},
                          {0, 0, -1},
                          {5, -4, 0},
                          {5, 4, 0},
                          {-3, 0, 4},
                          {0, 3, 5},
                          {0, -3, 5},
                          {15, 12, -40}}) {
    EXPECT_NEAR(closure(centre, normalized(n)), 1.0, 1e-12) << n.x << " " << n.y << " " << n.z;
  }
  EXPECT_NEAR(closure({2, 2, 1}, normalized(Vector{1, -1, 0})), 1.0, 1e-12) << "an edge runs through the horizon";
  EXPECT_NEAR(closure({1, 1, 1}, normalized(Vector{1, 1, -2})), 1.0, 1e-12) << "a corner lies on the horizon";
}

TEST(PointFormFactor, ABoxFillsTheHemisphereOfPointsCloseToItsSides) {
  for (const double gap : {1e-3, 1e-5}) {
    EXPECT_NEAR(closure({1.3, 2.2, gap}, {0, 0, 1}) + seen({1.3, 2.2, gap}, {0, 0, 1}, box_sides()[0]), 1.0, 1e-10);
    EXPECT_NEAR(closure({gap, gap, gap}, normalized(Vector{1, 2, 3})), 1.0, 1e-10);
  }
}

TEST(PointFormFactor, DoesNotDependOnTheOrderOfEdges) {
  const Polygon polygon{{{-1, -2, 1.2}, {-1.5, 2, 0.3}, {1, 2.5, 0.2}, {1.3, 0, 0.75}}};
  const Polygon square = rectangle_down(2, 2, 0.5);
  const Vector normal = normalized(Vector{0.8, -0.3, 0.2});
  for (const Polygon& p : {polygon, square}) {
    auto edges = p.outline();
    const double expected = point_form_factor({0.2, 0.4, 0}, normal, edges, p.normal());
    std::swap(edges[0], edges[2]);
    std::swap(edges[1], edges[3]);
    EXPECT_NEAR(point_form_factor({0.2, 0.4, 0}, normal, edges, p.normal()), expected, 1e-15);
  }
}

TEST(PointFormFactor, HoleIsTakenAwayWhateverTheTilt) {
  const Polygon outer{{{-2, -2, 1}, {-2, 2, 1}, {2, 2, 1}, {2, -2, 1}}};
  const Polygon inner{{{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}};
  std::vector<OutlineEdge> ring = outer.outline();
  for (const OutlineEdge& e : inner.outline()) ring.push_back({e.to, e.from});
  for (const Vector& n : {Vector{0, 0, 1}, {1, 0, 0.2}, {0.3, -1, 0}, {1, 1, -0.4}}) {
    const Vector normal = normalized(n);
    const Point at{0.4, -0.3, 0};
    EXPECT_NEAR(point_form_factor(at, normal, ring, outer.normal()), seen(at, normal, outer) - seen(at, normal, inner),
                1e-13);
  }
}

}  // namespace
}  // namespace clerestory::lighting
