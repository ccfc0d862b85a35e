// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminaire.h"

#include <gtest/gtest.h>

#include "tests/support/lamps.h"

namespace clerestory::lighting {
namespace {

using mesh::Vector;

void expect_near(const Vector& a, const Vector& b) { EXPECT_LT(norm(a - b), 1e-12) << a.x << ' ' << a.y << ' ' << a.z; }

TEST(LuminaireAxes, OfADownlightAreThoseOfTheModel) {
  const mesh::Frame axes = luminaire_axes({0, 0, -2}, 0.0);
  expect_near(axes.u, {1, 0, 0});
  expect_near(axes.v, {0, 1, 0});
  expect_near(axes.w, {0, 0, 1});
}

TEST(LuminaireAxes, RotationRunsFromC0ToC90) {
  const mesh::Frame axes = luminaire_axes({0, 0, -1}, 90.0);
  expect_near(axes.u, {0, 1, 0});
  expect_near(axes.v, {-1, 0, 0});
}

TEST(LuminaireAxes, C0HalfPlaneHoldsXOrZ) {
  const mesh::Frame tilted = luminaire_axes({1, 0, -1}, 0.0);
  EXPECT_GT(tilted.u.x, 0.7);
  EXPECT_NEAR(dot(tilted.u, tilted.w), 0.0, 1e-12);
  for (const double sign : {1.0, -1.0}) expect_near(luminaire_axes({sign, 0, 0}, 0.0).u, {0, 0, 1});
}

TEST(Luminaire, ShinesWhereItAims) {
  Luminaire lamp = test::lambertian_lamp({1, 2, 3}, {0, 1, 0}, 100.0);
  lamp.factor = 0.8;
  EXPECT_NEAR(lamp.intensity_cd({0, 1, 0}), 80.0, 1e-9);
  EXPECT_EQ(lamp.intensity_cd({0, -1, 0}), 0.0);
  EXPECT_NEAR(lamp.intensity_cd(normalized(Vector{1, 1, 0})), 80.0 * std::sqrt(0.5), 1e-3);
  EXPECT_NEAR(lamp.peak_cd(), 80.0, 1e-9);
}

}  // namespace
}  // namespace clerestory::lighting
