// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/uncovering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace clerestory::mesh {
namespace {

constexpr Vector kUp{0, 0, 1};
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kHeight_m = 2.0;  ///< of the occluder
constexpr double kAside_m = 1.5;   ///< from the receiver to below the occluder, along y
constexpr double kSource_m = 3.0;  ///< from the occluder on to the source
constexpr double kHalf_m =
    0.02;  ///< of the source's edge: so short that all of it is seen under one angle to the normal

constexpr Point kReceiver{0, 0, 0};
constexpr Point kOccluder{0, kAside_m, kHeight_m};
const double kDistance_m = std::hypot(kAside_m, kHeight_m);
const Vector kAhead = (kOccluder - kReceiver) / kDistance_m;
const double kCosine = kHeight_m / kDistance_m;

/// The plane of a source's edge and an occluder's edge along x; light comes out on the side of larger y.
Wedge parallel_edges(double source_from, double source_to) {
  const Point source = kOccluder + kSource_m * kAhead;
  Wedge wedge;
  wedge.order = 1;
  wedge.free_side = {0, kAhead.z, -kAhead.y};
  wedge.edge = {Point{-5, kOccluder.y, kOccluder.z}, Point{5, kOccluder.y, kOccluder.z}};
  wedge.along = {Point{source_from, source.y, source.z}, Point{source_to, source.y, source.z}};
  return wedge;
}

/// A corner whose edges leave the plane at 45 degrees to either side.
Wedge corner() {
  Wedge wedge = parallel_edges(0, 0);
  wedge.order = 2;
  wedge.corner = {wedge.free_side + Vector{1, 0, 0}, wedge.free_side - Vector{1, 0, 0}};
  return wedge;
}

/// The angle between occluder and source, so far apart on a line through the receiver, as seen from one that is displaced [rad].
double gap(double displaced_m, double source_m) {
  const Point from{0, displaced_m, 0};
  const auto direction = [&](const Point& p) { return std::atan2(p.y - from.y, p.z - from.z); };
  const double occluder = direction(kOccluder);
  return std::abs(occluder -
                  (std::isinf(source_m) ? std::atan2(kAhead.y, kAhead.z) : direction(kOccluder + source_m * kAhead)));
}

TEST(Uncovering, OfParallelEdgesIsTheAngleThatTheyShareTimesHowFastTheyPart) {
  constexpr double kStep_m = 1e-5;
  const double angle = 2.0 * std::atan(kHalf_m / (kDistance_m + kSource_m));
  const double expected = kCosine * angle * gap(kStep_m, kSource_m) / kStep_m;
  const Sight sight{kReceiver, kOccluder, kSource_m};
  EXPECT_NEAR(uncovering(parallel_edges(-kHalf_m, kHalf_m), sight, kUp), expected, 1e-4 * expected);
  EXPECT_NEAR(uncovering(parallel_edges(-kHalf_m, kHalf_m), sight, -kUp), expected, 1e-4 * expected);
  // Half of it stands beyond the end of the occluder's edge.
  Wedge half = parallel_edges(-kHalf_m, kHalf_m);
  half.edge[0].x = 0.0;
  EXPECT_NEAR(uncovering(half, sight, kUp), 0.5 * expected, 1e-4 * expected);
}

TEST(Uncovering, AtACornerIsWhatLiesBetweenItsEdgesAsTheSquare) {
  constexpr double kStep_m = 1e-5;
  for (const double source_m : {kSource_m, kInfinite}) {
    // A triangle as high as the gap and twice as wide: its area is the gap's square, and half of the second derivative.
    const double rate = gap(kStep_m, source_m) / kStep_m;
    const double expected = kCosine * 2.0 * rate * rate;
    EXPECT_NEAR(uncovering(corner(), {kReceiver, kOccluder, source_m}, kUp), expected, 1e-4 * expected);
  }
}

TEST(Uncovering, IsNothingWhereNothingPartsOrIsShared) {
  const Sight sight{kReceiver, kOccluder, kSource_m};
  Wedge edge_of_shadow = corner();
  edge_of_shadow.order = 0;
  EXPECT_EQ(uncovering(edge_of_shadow, sight, kUp), 0.0);
  EXPECT_EQ(uncovering(corner(), {kOccluder, kOccluder, kSource_m}, kUp), 0.0);
  EXPECT_EQ(uncovering(corner(), {kReceiver, kOccluder, 0.0}, kUp), 0.0);
  EXPECT_EQ(uncovering(parallel_edges(20.0, 21.0), sight, kUp), 0.0);
}

TEST(Uncovering, OfACornerWithAnEdgeInThePlaneIsFinite) {
  Wedge wedge = corner();
  wedge.corner[0] = {1, 0, 0};
  EXPECT_TRUE(std::isfinite(uncovering(wedge, {kReceiver, kOccluder, kSource_m}, kUp)));
}

}  // namespace
}  // namespace clerestory::mesh
