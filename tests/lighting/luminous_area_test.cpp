// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminous_area.h"

#include <gtest/gtest.h>

namespace clerestory::lighting {
namespace {

using mesh::Point;

Luminaire of(LuminousOpening::Shape shape, double x, double y, double z) {
  Luminaire luminaire;
  luminaire.opening = {.shape = shape, .x_m = x, .y_m = y, .z_m = z};
  return luminaire;
}

template <class Function>
AreaMean near_mean(const Luminaire& luminaire, const Function& function) {
  return mean_over_opening(luminaire, luminaire.at, function, kFineMean);
}

TEST(MeanOverOpening, OfACubicIsExact) {
  const auto box = of(LuminousOpening::Shape::kRectangle, 2, 4, 1);
  const AreaMean mean = near_mean(box, [](const Point& p) { return 9 + p.x * p.x + p.y * p.y * p.x + p.z * p.z; });
  EXPECT_NEAR(mean.value, 9.0 + 4.0 / 12.0 + 1.0 / 12.0, 1e-12);
  EXPECT_LT(mean.error, 1e-12);
}

TEST(MeanOverOpening, OfADiscHasTheDiscsMoments) {
  const auto disc = of(LuminousOpening::Shape::kEllipse, 2, 2, 0);
  const AreaMean mean = near_mean(disc, [](const Point& p) { return p.x * p.x + p.y * p.y; });
  EXPECT_NEAR(mean.value, 0.5, 1e-12);
}

TEST(MeanOverOpening, StatesWhatAnEdgeLeavesOpen) {
  const auto square = of(LuminousOpening::Shape::kRectangle, 1, 1, 0);
  const AreaMean mean = near_mean(square, [](const Point& p) { return p.x + p.y < 0.13 ? 1.0 : 0.0; });
  const double expected = 1.0 - 0.5 * 0.87 * 0.87;
  EXPECT_NEAR(mean.value, expected, 2.0 * mean.error);
  EXPECT_GT(mean.error, 0.0);
  EXPECT_LT(mean.error, 0.02);
}

TEST(MeanOverOpening, FromAfarIsThatOfTheCentre) {
  const auto square = of(LuminousOpening::Shape::kRectangle, 3, 4, 0);
  int calls = 0;
  const auto count = [&](const Point&) { return static_cast<double>(++calls); };
  mean_over_opening(square, {0, 0, 25.001}, count, kFineMean);
  EXPECT_EQ(calls, 1);
  mean_over_opening(square, {0, 0, 24.999}, count, kFineMean);
  EXPECT_GT(calls, 4);
}

}  // namespace
}  // namespace clerestory::lighting
