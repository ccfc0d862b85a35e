// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ies_opening.h"

#include <gtest/gtest.h>

namespace clerestory::io {
namespace {

using Shape = lighting::LuminousOpening::Shape;

struct Case {
  double width, length, height;
  int year;
  Shape shape;
  double x, y, z;
};

TEST(IesOpening, SignsTellTheShape) {
  for (const Case& c : {Case{0, 0, 0, 2002, Shape::kPoint, 0, 0, 0},
                        {.3, 1.2, 0, 2002, Shape::kRectangle, 1.2, .3, 0},
                        {.3, 1.2, .1, 1995, Shape::kRectangle, 1.2, .3, .1},
                        {-.2, 0, 0, 1995, Shape::kEllipse, .2, .2, 0},
                        {-.2, -.2, 0, 2002, Shape::kEllipse, .2, .2, 0},
                        {-.2, 0, .3, 1995, Shape::kEllipse, .2, .2, .3},
                        {-.2, -.4, .3, 2019, Shape::kEllipse, .4, .2, .3},
                        {-.2, .4, 0, 1995, Shape::kEllipse, .4, .2, 0},
                        {.2, -.4, 0, 1995, Shape::kEllipse, .4, .2, 0},
                        {-.2, 0, -.2, 1995, Shape::kEllipsoid, .2, .2, .2},
                        {-.2, -.2, -.2, 2002, Shape::kEllipsoid, .2, .2, .2},
                        {-.2, .4, -.1, 1995, Shape::kEllipsoid, .4, .2, .1},
                        {0, 1.2, -.1, 1995, Shape::kCylinderAlongX, 1.2, .1, .1},
                        {.6, 0, -.1, 1995, Shape::kCylinderAlongY, .1, .6, .1},
                        {-.1, 1.2, -.1, 2002, Shape::kCylinderAlongX, 1.2, .1, .1},
                        {.6, -.1, -.1, 2019, Shape::kCylinderAlongY, .1, .6, .1},
                        {-.2, 0, -.2, 2002, Shape::kUprightDisc, 0, .2, .2}}) {
    const auto opening = ies_opening(c.width, c.length, c.height, c.year);
    ASSERT_TRUE(opening) << c.width << ' ' << c.length << ' ' << c.height << ' ' << c.year;
    EXPECT_EQ(opening->shape, c.shape) << c.width << ' ' << c.length << ' ' << c.height << ' ' << c.year;
    EXPECT_DOUBLE_EQ(opening->x_m, c.x);
    EXPECT_DOUBLE_EQ(opening->y_m, c.y);
    EXPECT_DOUBLE_EQ(opening->z_m, c.z);
  }
}

TEST(IesOpening, SomeSignsMeanNothing) { EXPECT_FALSE(ies_opening(.2, .3, -.1, 2002)); }

}  // namespace
}  // namespace clerestory::io
