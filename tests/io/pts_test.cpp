// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/pts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/refusal.h"
#include "tests/support/places.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::HasSubstr;

SensorPoints read(const std::string& text) {
  const test::ScratchFolder scratch;
  test::write_text(scratch.path() / "desk.pts", text);
  return read_pts(scratch.path() / "desk.pts");
}

std::string refusal(const std::string& text) {
  return test::refusal_of([&] { read(text); });
}

TEST(Pts, KeepsTheOrderAndPassesOverComments) {
  const auto sensors = read("# x y z nx ny nz\n1 2 0.8 0 0 1\n\n\t3\t4  0.8 0 0 1\r\n");
  ASSERT_EQ(sensors.points.size(), 2U);
  EXPECT_EQ(sensors.points[0], (mesh::Point{1.0, 2.0, 0.8}));
  EXPECT_EQ(sensors.points[1], (mesh::Point{3.0, 4.0, 0.8}));
}

TEST(Pts, NormalsGetTheLengthOne) {
  const auto sensors = read("0 0 0 0 3 4\n");
  EXPECT_DOUBLE_EQ(sensors.normals[0].y, 0.6);
  EXPECT_DOUBLE_EQ(sensors.normals[0].z, 0.8);
}

TEST(Pts, BadLinesAreRefusedWithTheirNumber) {
  EXPECT_THAT(refusal("0 0 0 0 0 1\n0 0 0 0 0\n"), HasSubstr("desk.pts:2: a sensor has 6 numbers, this line has 5"));
  EXPECT_THAT(refusal("0 0 0 0 0 1 7\n"), HasSubstr("this line has 7"));
  EXPECT_THAT(refusal("0 0 0 0 0 0\n"), HasSubstr("desk.pts:1: the normal of this sensor is zero"));
  EXPECT_THAT(refusal("0 nan 0 0 0 1\n"), HasSubstr("desk.pts:1: 'nan' is no finite number"));
  EXPECT_THAT(refusal("0 1e99 0 0 0 1\n"), HasSubstr("'1e99' lies beyond any building"));
  EXPECT_THAT(refusal("# nothing\n"), HasSubstr("desk.pts: there is no sensor in this file"));
}

TEST(Pts, TheReferenceSensorsAreReadWhole) {
  CLERESTORY_NEEDS_VALIDATION("office");
  EXPECT_EQ(read_pts(test::validation_dir() / "office" / "sensors.pts").points.size(), 768U);
  EXPECT_EQ(read_pts(test::validation_dir() / "atrium" / "sensors.pts").points.size(), 900U);
}

}  // namespace
}  // namespace clerestory::io
