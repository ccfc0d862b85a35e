// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/arc_tangent.h"

#include <gtest/gtest.h>

namespace clerestory::lighting {
namespace {

TEST(ArcTangent, IsTheLibrarysInAllQuadrantsToTheLastDigits) {
  constexpr int kSteps = 20'000;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = std::numbers::pi * (2.0 * (i + 0.5) / kSteps - 1.0);
    for (const double radius : {1e-9, 1.0, 37.5}) {
      const double y = radius * std::sin(angle);
      const double x = radius * std::cos(angle);
      const double expected = std::atan2(y, x);
      ASSERT_NEAR(arc_tangent(y, x), expected, 2e-15 * std::abs(expected));
    }
  }
}

TEST(ArcTangent, SmallAnglesKeepTheirDigits) {
  for (const double angle : {1e-300, 1e-20, 1e-9, 1e-4}) {
    EXPECT_NEAR(arc_tangent(angle, 1.0), std::atan2(angle, 1.0), 2e-15 * angle);
    EXPECT_NEAR(arc_tangent(-angle, 1.0), std::atan2(-angle, 1.0), 2e-15 * angle);
  }
}

TEST(ArcTangent, AxesAreExact) {
  EXPECT_EQ(arc_tangent(0.0, 1.0), 0.0);
  EXPECT_EQ(arc_tangent(1.0, 0.0), 0.5 * std::numbers::pi);
  EXPECT_EQ(arc_tangent(-1.0, 0.0), -0.5 * std::numbers::pi);
  EXPECT_EQ(arc_tangent(0.0, -1.0), std::numbers::pi);
  EXPECT_EQ(arc_tangent(0.0, 0.0), 0.0);
}

}  // namespace
}  // namespace clerestory::lighting
