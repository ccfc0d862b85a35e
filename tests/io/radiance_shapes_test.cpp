// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clerestory::io {
namespace {

constexpr double kPi = std::numbers::pi;

RadiancePrimitive primitive(std::string_view type, std::vector<double> reals) {
  RadiancePrimitive result;
  result.type = type;
  result.reals = std::move(reals);
  return result;
}

mesh::Vector doubled_area(const Shape& shape, const std::vector<std::uint32_t>& loop) {
  mesh::Vector sum;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum = sum +
          mesh::cross(shape.points[loop[i]] - shape.points[loop[0]], shape.points[loop[i + 1]] - shape.points[loop[0]]);
  return sum;
}

double area(const Shape& shape) {
  double sum = 0.0;
  for (const ShapePolygon& polygon : shape.polygons) {
    sum += 0.5 * mesh::norm(doubled_area(shape, polygon.outer));
    if (!polygon.hole.empty()) sum -= 0.5 * mesh::norm(doubled_area(shape, polygon.hole));
  }
  return sum;
}

/// Above zero where fronts look away from the point.
double volume_about(const Shape& shape, const mesh::Point& p) {
  double sum = 0.0;
  for (const ShapePolygon& polygon : shape.polygons)
    sum += mesh::dot(doubled_area(shape, polygon.outer), shape.points[polygon.outer[0]] - p) / 6.0;
  return sum;
}

TEST(RadianceShapes, ASphereHasItsAreaAndLooksOutward) {
  const Shape sphere = radiance_shape(primitive("sphere", {1.0, 2.0, 3.0, 0.5}));
  EXPECT_NEAR(area(sphere), 4.0 * kPi * 0.25, 1e-12);
  EXPECT_GT(volume_about(sphere, {1.0, 2.0, 3.0}), 0.97 * 4.0 / 3.0 * kPi * 0.125);
  const Shape bubble = radiance_shape(primitive("bubble", {1.0, 2.0, 3.0, 0.5}));
  EXPECT_NEAR(volume_about(bubble, {1.0, 2.0, 3.0}), -volume_about(sphere, {1.0, 2.0, 3.0}), 1e-12);
  EXPECT_GT(volume_about(radiance_shape(primitive("bubble", {0.0, 0.0, 0.0, -1.0})), {}), 0.0);
}

TEST(RadianceShapes, ACylinderHasItsAreaWhicheverWayItsAxisRuns) {
  for (const std::vector<double>& ends :
       {std::vector<double>{0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.3}, {1.0, 1.0, 1.0, -1.0, 0.5, 0.0, 0.3}}) {
    const Shape cylinder = radiance_shape(primitive("cylinder", ends));
    const double length = std::hypot(ends[3] - ends[0], ends[4] - ends[1], ends[5] - ends[2]);
    const mesh::Point middle = mesh::midpoint({ends[0], ends[1], ends[2]}, {ends[3], ends[4], ends[5]});
    EXPECT_NEAR(area(cylinder), 2.0 * kPi * 0.3 * length, 1e-12);
    EXPECT_GT(volume_about(cylinder, middle), 0.0);
    EXPECT_LT(volume_about(radiance_shape(primitive("tube", ends)), middle), 0.0);
  }
}

TEST(RadianceShapes, AConeEndsInItsTip) {
  const Shape cone = radiance_shape(primitive("cone", {0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 1.0, 0.0}));
  const std::size_t pieces = circle_pieces(1.0);
  EXPECT_EQ(cone.points.size(), pieces + 1);
  EXPECT_EQ(cone.polygons.size(), pieces);
  for (const ShapePolygon& polygon : cone.polygons) EXPECT_EQ(polygon.outer.size(), 3U);
  EXPECT_NEAR(area(cone), kPi * std::sqrt(5.0), 0.01 * kPi * std::sqrt(5.0));
  EXPECT_GT(volume_about(cone, {0.0, 0.0, 1.0}), 0.0);
  EXPECT_LT(
      volume_about(radiance_shape(primitive("cup", cone.polygons.empty()
                                                       ? std::vector<double>{}
                                                       : std::vector<double>{0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 1.0, 0.0})),
                   {0.0, 0.0, 1.0}),
      0.0);
}

TEST(RadianceShapes, ARingIsOnePolygonWithAHoleThatLooksAlongItsNormal) {
  const Shape ring = radiance_shape(primitive("ring", {0.0, 0.0, 3.0, 0.0, 0.0, -2.0, 0.5, 1.0}));
  ASSERT_EQ(ring.polygons.size(), 1U);
  EXPECT_FALSE(ring.polygons[0].hole.empty());
  EXPECT_LT(doubled_area(ring, ring.polygons[0].outer).z, 0.0);
  EXPECT_GT(doubled_area(ring, ring.polygons[0].hole).z, 0.0);
  EXPECT_NEAR(area(ring), 0.75 * kPi, 0.006 * 0.75 * kPi);
  EXPECT_TRUE(radiance_shape(primitive("ring", {0.0, 0.0, 3.0, 0.0, 0.0, 1.0, 0.0, 1.0})).polygons[0].hole.empty());
}

TEST(RadianceShapes, ACylinderAndTheDiskAtItsEndShareTheirCorners) {
  const Shape cylinder = radiance_shape(primitive("cylinder", {0.0, 0.0, 0.0, 0.3, 0.4, 2.0, 0.3}));
  const Shape lid = radiance_shape(primitive("ring", {0.3, 0.4, 2.0, -0.3, -0.4, -2.0, 0.0, 0.3}));
  for (const mesh::Point& p : lid.points) {
    double nearest = 1.0;
    for (const mesh::Point& q : cylinder.points) nearest = std::min(nearest, mesh::norm(p - q));
    EXPECT_LT(nearest, 1e-12);
  }
}

TEST(RadianceShapes, ChordsStayNearTheirArcs) {
  for (const double radius : {0.001, 0.01, 0.1, 1.0, 10.0}) {
    const auto pieces = static_cast<double>(circle_pieces(radius));
    const double chord = radius * (1.0 - std::cos(kPi / pieces));
    EXPECT_LE(chord, std::max(kFinestChord, std::min(kCoarsestChord, kChordOverRadius * radius)) * (1.0 + 1e-9));
  }
  EXPECT_EQ(circle_pieces(0.0), 8U);
  EXPECT_EQ(circle_pieces(1e300), 128U);
  // A model in millimetres that is scaled to metres later keeps as many pieces.
  EXPECT_EQ(radiance_shape(primitive("sphere", {0.0, 0.0, 0.0, 500.0}), 0.001).polygons.size(),
            radiance_shape(primitive("sphere", {0.0, 0.0, 0.0, 0.5})).polygons.size());
}

TEST(RadianceShapes, NumbersThatMakeNoSurfaceGiveNone) {
  for (const RadiancePrimitive& bad :
       {primitive("polygon", {0.0, 0.0, 0.0, 1.0, 0.0, 0.0}), primitive("polygon", std::vector<double>(10)),
        primitive("sphere", {0.0, 0.0, 0.0, 0.0}), primitive("sphere", {1.0}),
        primitive("ring", std::vector<double>(8)), primitive("cylinder", {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}),
        primitive("cone", std::vector<double>(7)), primitive("cone", {0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0})})
    EXPECT_TRUE(radiance_shape(bad).polygons.empty()) << bad.type;
}

}  // namespace
}  // namespace clerestory::io
