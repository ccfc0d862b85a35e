// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/polar_diagram.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clerestory::io {
namespace {

/// How many pixels near a place have a colour that is not grey.
int coloured_near(const Raster& raster, double x, double y) {
  int count = 0;
  for (int i = -4; i <= 4; ++i) {
    for (int j = -4; j <= 4; ++j) {
      const Rgb c = raster.at(static_cast<int>(x) + i, static_cast<int>(y) + j);
      count += std::abs(c.r - c.b) > 60 ? 1 : 0;
    }
  }
  return count;
}

TEST(PolarDiagram, DrawsTheCurveWhereTheIntensityIs) {
  // 300 cd towards C0, 150 cd towards C180, in all angles from straight down.
  const lighting::PhotometricWeb web(
      {.polar_deg = {0, 90}, .azimuth_deg = {0, 90, 180, 270}, .candela = {300, 300, 150, 150, 150, 150, 150, 150}});
  const Raster raster = polar_diagram(web, "Lamp");
  // The outermost ring, 340 pixels about (400, 450), is 300 cd; straight down is below.
  const double down = std::sqrt(0.5);
  EXPECT_GT(coloured_near(raster, 400 + 340 * down, 450 + 340 * down), 5);
  EXPECT_EQ(coloured_near(raster, 400 - 340 * down, 450 + 340 * down), 0);
  EXPECT_GT(coloured_near(raster, 400 - 170 * down, 450 + 170 * down), 5);
  EXPECT_EQ(coloured_near(raster, 400 + 250 * down, 450 - 250 * down), 0);
  EXPECT_EQ(raster.png().substr(1, 3), "PNG");
}

}  // namespace
}  // namespace clerestory::io
