// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/receiver.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "lighting/form_factor.h"
#include "lighting/sampling.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

constexpr Vector kUp{0.0, 0.0, 1.0};

TEST(Receiver, APlaneCountsByTheCosineAndACylinderBySineOverPi) {
  const Vector to{0.6, 0.0, 0.8};
  EXPECT_DOUBLE_EQ(Receiver(kUp).kernel(to), 0.8);
  EXPECT_DOUBLE_EQ(Receiver(kUp).kernel(-to), -0.8);
  EXPECT_NEAR(Receiver::cylinder(kUp).kernel(to), 0.6 / std::numbers::pi, 1e-15);
  EXPECT_NEAR(Receiver::cylinder(kUp).kernel(-2.0 * to), 1.2 / std::numbers::pi, 1e-15);
  EXPECT_EQ(Receiver::cylinder(kUp).kernel(kUp), 0.0);
}

TEST(Receiver, ACylinderIsTheMeanOfThePlanesAboutIt) {
  const Vector to = mesh::normalized({0.5, -0.3, 0.4});
  double sum = 0.0;
  constexpr int kPlanes = 100000;
  for (int k = 0; k < kPlanes; ++k) {
    const double phi = 2.0 * std::numbers::pi * k / kPlanes;
    sum += std::max(0.0, Receiver({std::cos(phi), std::sin(phi), 0.0}).kernel(to)) / kPlanes;
  }
  EXPECT_NEAR(Receiver::cylinder(kUp).kernel(to), sum, 1e-9);
}

TEST(Receiver, DirectionsHaveTheDensityOfTheKernel) {
  // Of luminance cos²θ a cylinder receives π/4, a plane π/2; of sin²φ half of what it receives of one.
  const Vector axis = mesh::normalized({0.2, 0.3, 0.9});
  const mesh::Frame frame = mesh::frame_around(axis);
  const SobolPoints points(7);
  constexpr std::uint32_t kCount = 1U << 16U;
  for (const bool cylinder : {false, true}) {
    const Receiver receiver = cylinder ? Receiver::cylinder(axis) : Receiver(axis);
    double along = 0.0;
    double across = 0.0;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const Vector d = receiver.direction(frame, points.at(i, 0), points.at(i, 1));
      EXPECT_NEAR(norm(d), 1.0, 1e-9);
      along += dot(d, axis) * dot(d, axis) / kCount;
      const double v = dot(d, frame.v);
      across += v * v / std::max(1e-30, 1.0 - dot(d, axis) * dot(d, axis)) / kCount;
    }
    EXPECT_NEAR(along, cylinder ? 0.25 : 0.5, 1e-4);
    EXPECT_NEAR(across, 0.5, 1e-4);
  }
}

TEST(Receiver, ASmallPolygonGivesACylinderSineOverPiOfWhatItGivesAPlaneThatFacesIt) {
  const double half = 1e-3;
  const std::array<Point, 4> corners{{{-half, -half, 2}, {-half, half, 2}, {half, half, 2}, {half, -half, 2}}};
  std::array<mesh::OutlineEdge, 4> outline;
  for (std::size_t k = 0; k < 4; ++k) outline[k] = {corners[k], corners[(k + 1) % 4]};
  for (const Point& at : {Point{1.5, 0, 0}, Point{-1, 2, 1}, Point{0.3, -0.7, 0.5}}) {
    const Vector to = Point{0, 0, 2} - at;
    const double facing = point_form_factor(at, normalized(to), outline, -kUp);
    const double expected = facing * Receiver::cylinder(kUp).kernel(normalized(to));
    EXPECT_NEAR(Receiver::cylinder(kUp).form_factor(at, outline, -kUp) / expected, 1.0, 3e-4);
    EXPECT_DOUBLE_EQ(Receiver(kUp).form_factor(at, outline, -kUp), point_form_factor(at, kUp, outline, -kUp));
  }
}

TEST(Receiver, ASetHasPlanesOrCylinders) {
  const std::array<Point, 1> positions{{{1, 2, 3}}};
  const std::array<Vector, 1> axes{kUp};
  EXPECT_FALSE((SensorSet{positions, axes}.receiver(0).is_cylinder()));
  EXPECT_TRUE((SensorSet{positions, axes, true}.receiver(0).is_cylinder()));
  EXPECT_EQ((SensorSet{positions, axes, true}.count()), 1U);
}

}  // namespace
}  // namespace clerestory::lighting
