// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/opening_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lighting/form_factor.h"
#include "lighting/sampling.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;
using Triangle = std::array<Point, 3>;

/// The form factor of triangles that face a point, all of them in front of it.
double form_factor(const Point& at, const Vector& normal, const std::vector<Triangle>& triangles) {
  double sum = 0.0;
  for (const Triangle& t : triangles) {
    const std::array<mesh::OutlineEdge, 3> outline{{{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}}};
    sum += point_form_factor(at, normal, outline, normalized(cross(t[1] - t[0], t[2] - t[0])));
  }
  return sum;
}

/// The same by the sampler: the mean of cosine × inverse density, over pi.
double sampled_form_factor(const Point& at, const Vector& normal, const std::vector<Triangle>& triangles) {
  const OpeningSampler sampler(at, triangles);
  constexpr std::uint32_t kCount = 16384;
  double sum = 0.0;
  const SobolPoints points(9);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const SolidAngleSample s = sampler.sample(points.at(i, 0), points.at(i, 1));
    sum += s.solid_angle_sr * std::max(0.0, dot(s.direction, normal));
  }
  return sum / (kCount * std::numbers::pi);
}

/// Rectangle [0, a] × [0, b] at a height, facing down.
std::vector<Triangle> skylight(double a, double b, double height) {
  return {{{{0, 0, height}, {0, b, height}, {a, b, height}}}, {{{0, 0, height}, {a, b, height}, {a, 0, height}}}};
}

TEST(OpeningSampler, SolidAngleOfACubesFaceFromItsCentreIsASixthOfAll) {
  const auto triangles = skylight(1, 1, 1);
  const OpeningSampler sampler({0.5, 0.5, 0.5}, triangles);
  EXPECT_NEAR(sampler.solid_angle_sr(), 4.0 * std::numbers::pi / 6.0, 1e-12);
}

TEST(OpeningSampler, IntegralOfTheCosineIsTheFormFactor) {
  struct Case {
    Point at;
    Vector normal;
    std::vector<Triangle> triangles;
  };
  for (const Case& k :
       {Case{{0.5, 0.5, 0}, {0, 0, 1}, skylight(1, 1, 1)}, Case{{3, 2, 0}, {0, 0, 1}, skylight(1, 1, 1)},
        Case{{3, 2, 0}, normalized(Vector{-1, 0, 0.3}), skylight(1, 4, 1)},
        Case{{0.4, 0.3, 0}, normalized(Vector{1, 0.3, 0.1}), skylight(2, 2, 0.5)},
        Case{{0.2, 0.7, 0}, {0, 0, 1}, skylight(1, 1, 0.01)}, Case{{5, 5, 0}, {0, 0, 1}, skylight(10, 0.01, 2)}}) {
    const double exact = form_factor(k.at, k.normal, k.triangles);
    EXPECT_NEAR(sampled_form_factor(k.at, k.normal, k.triangles), exact, 1e-3 * exact);
  }
}

TEST(OpeningSampler, DirectionsAreUniformInSolidAngle) {
  // Of a window of 2 m × 1 m, the share of directions that end on a part is the part's share of the solid angle.
  const Point at{0.3, 0.2, 0};
  const auto window = skylight(2, 1, 1);
  const auto corner = skylight(0.5, 0.5, 1);
  const OpeningSampler whole(at, window);
  const OpeningSampler part(at, corner);
  constexpr std::uint32_t kCount = 16384;
  const SobolPoints points(4);
  int on_part = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const Vector d = whole.sample(points.at(i, 0), points.at(i, 1)).direction;
    const Point hit = at + (1.0 / d.z) * d;
    on_part += hit.x < 0.5 && hit.y < 0.5 ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(on_part) / kCount, part.solid_angle_sr() / whole.solid_angle_sr(), 2e-3);
}

/// Least barycentric coordinate of where a ray meets a triangle's plane.
double least_barycentric(const Triangle& t, const Point& from, const Vector& d) {
  const Vector n = cross(t[1] - t[0], t[2] - t[0]);
  const Point p = from + (dot(t[0] - from, n) / dot(d, n)) * d;
  double least = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    least = std::min(least, dot(cross(t[(k + 1) % 3] - t[k], p - t[k]), n) / dot(n, n));
  }
  return least;
}

TEST(OpeningSampler, EveryDirectionMeetsTheTriangle) {
  const Triangle ordinary{{{0, 0, 1}, {0, 1, 1}, {1, 0, 1.4}}};
  const Triangle needle{{{-3, 0, 1}, {3, 0.004, 1}, {3, 0, 1}}};
  const Triangle far_off{{{0, 0, 250}, {0, 1, 250}, {1, 0, 250}}};
  const Triangle farther{{{0, 0, 5000}, {0, 1, 5000}, {1, 0, 5000}}};
  const Triangle close_by{{{-1, -1, 1e-3}, {0, 2, 1e-3}, {1, -1, 1e-3}}};
  for (const Triangle& t : {ordinary, needle, far_off, farther, close_by}) {
    const OpeningSampler sampler({0, 0, 0}, std::span(&t, 1));
    const SobolPoints points(2);
    for (std::uint32_t i = 0; i < 1000; ++i) {
      const SolidAngleSample s = sampler.sample(points.at(i, 0), points.at(i, 1));
      EXPECT_GT(s.solid_angle_sr, 0.0);
      ASSERT_GE(least_barycentric(t, {0, 0, 0}, s.direction), -1e-5) << t[0].x << " " << t[0].z;
    }
  }
}

TEST(OpeningSampler, TinyTrianglesKeepTheirSolidAngle) {
  // A square millimetre at 3 m, tilted by 60 degrees: area × cosine / distance².
  const Vector u{1e-3, 0, 0};
  const Vector v{0, 0.5e-3, std::sqrt(0.75) * 1e-3};
  const Point p{0, 0, 3};
  const std::vector<Triangle> tiny{{{p, p + v, p + u}}};
  const double expected = 0.5e-6 * 0.5 / 9.0;
  EXPECT_NEAR(OpeningSampler({0, 0, 0}, tiny).solid_angle_sr(), expected, 1e-3 * expected);
  EXPECT_NEAR(sampled_form_factor({0, 0, 0}, {0, 0, 1}, tiny), expected / std::numbers::pi, 1e-3 * expected);
}

TEST(OpeningSampler, TinyAndLargeTrianglesTogetherAddUp) {
  // A skylight cut so that one of its triangles is tiny.
  const Point corner{1e-4, 0, 1};
  const std::vector<Triangle> cut{{{{0, 0, 1}, {0, 1e-4, 1}, corner}},
                                  {{{0, 1e-4, 1}, {0, 1, 1}, corner}},
                                  {{{0, 1, 1}, {1, 1, 1}, corner}},
                                  {{{1, 1, 1}, {1, 0, 1}, corner}}};
  const double exact = form_factor({0.5, 0.5, 0}, {0, 0, 1}, skylight(1, 1, 1));
  EXPECT_NEAR(sampled_form_factor({0.5, 0.5, 0}, {0, 0, 1}, cut), exact, 1e-3 * exact);
}

TEST(OpeningSampler, SeenEdgeOnThereIsNothing) {
  const auto triangles = skylight(1, 1, 1);
  const OpeningSampler sampler({3, 0.5, 1}, triangles);
  EXPECT_NEAR(sampler.solid_angle_sr(), 0.0, 1e-12);
  EXPECT_NEAR(sampler.sample(0.5, 0.5).solid_angle_sr, 0.0, 1e-12);
  EXPECT_EQ(OpeningSampler({0, 0, 0}, {}).sample(0.5, 0.5).solid_angle_sr, 0.0);
}

TEST(OpeningSampler, CornersOfTheUnitSquareGiveUnitDirections) {
  const auto triangles = skylight(1, 1, 1);
  const OpeningSampler sampler({0.5, 0.5, 0}, triangles);
  for (const double a : {0.0, 0.5, 1.0}) {
    for (const double b : {0.0, 1.0}) {
      const SolidAngleSample s = sampler.sample(a, b);
      EXPECT_NEAR(norm(s.direction), 1.0, 1e-9);
      EXPECT_GT(s.solid_angle_sr, 0.0);
    }
  }
}

}  // namespace
}  // namespace clerestory::lighting
