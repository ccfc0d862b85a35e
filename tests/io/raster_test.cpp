// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/raster.h"

#include <algorithm>
#include <array>
#include <numbers>

#include <gtest/gtest.h>

#include "io/raster_text.h"

namespace clerestory::io {
namespace {

double total(const Mask& mask) {
  double sum = 0.0;
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) sum += static_cast<double>(mask.at(x, y));
  }
  return sum;
}

TEST(Mask, CoversTheAreaOfAPolygon) {
  Mask mask(100, 100);
  mask.add_polygon(std::array<Pixel, 4>{{{10.25, 10.5}, {60.75, 10.5}, {60.75, 50.0}, {10.25, 50.0}}});
  EXPECT_NEAR(total(mask), 50.5 * 39.5, 1e-3);
  EXPECT_FLOAT_EQ(mask.at(10, 20), 0.75F);
  EXPECT_FLOAT_EQ(mask.at(20, 10), 0.5F);
}

TEST(Mask, CoversTheAreaOfALineAndADisc) {
  Mask line(200, 200);
  line.add_line(std::array<Pixel, 2>{{{20, 30}, {140, 120}}}, false, 4.0);
  EXPECT_NEAR(total(line), 150.0 * 4.0 + 4.0 * std::numbers::pi, 6.0);
  Mask disc(200, 200);
  disc.add_disc({100.3, 99.1}, 40.0);
  EXPECT_NEAR(total(disc), std::numbers::pi * 1600.0, 15.0);
}

TEST(Mask, DropsWhatLiesOutside) {
  Mask mask(10, 10);
  mask.add_line(std::array<Pixel, 2>{{{-1e6, -50}, {1e6, -50}}}, false, 3.0);
  mask.add_polygon(std::array<Pixel, 3>{{{20, 20}, {30, 20}, {30, 30}}});
  EXPECT_EQ(total(mask), 0.0);
  mask.add_polygon(std::array<Pixel, 4>{{{-100, -100}, {100, -100}, {100, 100}, {-100, 100}}});
  EXPECT_NEAR(total(mask), 100.0, 1e-3);
}

TEST(Raster, MixesByCoverage) {
  Raster raster(4, 4, {200, 100, 0});
  raster.blend(1, 1, {0, 200, 100}, 0.5);
  EXPECT_EQ(raster.at(1, 1), (Rgb{100, 150, 50}));
  raster.blend(-1, 9, {0, 0, 0}, 1.0);
  EXPECT_EQ(raster.at(0, 0), (Rgb{200, 100, 0}));
}

TEST(Text, GrowsWithItsLengthAndKeepsItsHeight) {
  const TextImage shorter = render_text("aeo", {15, false});
  const TextImage longer = render_text("Illuminance Tgjp [lx]", {15, false});
  EXPECT_GT(longer.width, 3 * shorter.width);
  EXPECT_EQ(longer.height, shorter.height);
  EXPECT_EQ(longer.ink.size(), static_cast<std::size_t>(longer.width) * static_cast<std::size_t>(longer.height));
  EXPECT_GT(*std::max_element(longer.ink.begin(), longer.ink.end()), 200);
}

TEST(Text, OfControlCharactersIsOneLine) {
  EXPECT_EQ(render_text("a\nb\tc", {15, false}).height, render_text("abc", {15, false}).height);
  EXPECT_GT(render_text("", {15, false}).height, 0);
}

}  // namespace
}  // namespace clerestory::io
