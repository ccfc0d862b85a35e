// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "tests/io/refusal.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kFaces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kText = "ply\nformat ascii 1.0\n";
const std::string kVertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kTriangle = "0 0 0\n1 0 0\n0 1 0\n";

/// The bytes of a number in either order. Tests run on little-endian machines.
template <class Number>
std::string bytes_of(Number value, bool big_endian) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

class Ply : public testing::Test {
 protected:
  ModelFile read(const std::string& text) {
    test::write_text(path(), text);
    return read_ply(path());
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { read(text); });
  }
  std::filesystem::path path() const { return scratch_.path() / "bowl.ply"; }

 private:
  test::ScratchFolder scratch_;
};

TEST_F(Ply, TextIsReadWithItsLinesAndTheNameOfTheFile) {
  const auto file = read(kText + kVertices + kFaces + "612345.123456 5412345.654321 0.1\n\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(file.model.vertices[0], (mesh::Point{612345.123456, 5412345.654321, 0.1}));
  EXPECT_THAT(file.model.loop(0), ElementsAre(0, 1, 2));
  EXPECT_EQ(file.model.polygon_line[0], 14U);
  EXPECT_THAT(file.model.part_names, ElementsAre("bowl"));
}

TEST_F(Ply, BinaryIsReadInEitherByteOrderWithAnyTypes) {
  for (const bool big : {false, true}) {
    std::string text = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                       "_endian 1.0\nelement vertex 3\nproperty uchar red\nproperty double x\nproperty int16 y\n"
                       "property list ushort float weights\nproperty float z\nelement face 1\n"
                       "property list uint ushort vertex_index\nproperty int8 flags\nend_header\n";
    for (int i = 0; i < 3; ++i) {
      text +=
          bytes_of(std::uint8_t{200}, big) + bytes_of(i + 0.1, big) + bytes_of(static_cast<std::int16_t>(-i * i), big);
      text += bytes_of(std::uint16_t{2}, big) + bytes_of(1.0F, big) + bytes_of(2.0F, big) + bytes_of(0.5F, big);
    }
    text += bytes_of(3U, big);
    for (const auto corner : std::array<std::uint16_t, 3>{2, 1, 0}) text += bytes_of(corner, big);
    text += bytes_of(std::int8_t{-1}, big);
    const auto file = read(text);
    EXPECT_EQ(file.model.vertices[2], (mesh::Point{2.1, -4.0, 0.5}));
    EXPECT_THAT(file.model.loop(0), ElementsAre(2, 1, 0));
  }
}

TEST_F(Ply, TheHeaderMayEndItsLinesInAnyWayAndDataBeginWithAnyByte) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text = "ply|format binary_little_endian 1.0|" + kVertices + kFaces;
    std::replace(text.begin(), text.end(), '\n', '|');
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos;) text.replace(at, 1, end);
    text +=
        bytes_of(1.6455652e-43F, false).substr(0, 0) + std::string("\n\0\0\0", 4);  // a float whose first byte is LF
    for (int i = 0; i < 8; ++i) text += bytes_of(static_cast<float>(i * i), false);
    text += std::string("\3", 1) + bytes_of(0, false) + bytes_of(1, false) + bytes_of(2, false);
    const auto file = read(text);
    EXPECT_EQ(file.model.vertices[2].z, 49.0);
    EXPECT_EQ(file.notices.size(), 1U) << "only that of the unit: all bytes were used";
  }
}

TEST_F(Ply, OtherElementsArePassedOverWhereverTheyStand) {
  const auto file = read(kText + "element camera 1\nproperty float zoom\nproperty list uchar int lens\n" + kVertices +
                         "element edge 2\nproperty int vertex1\nproperty int vertex2\nproperty float crease\n" +
                         kFaces + "1.5 2 7 8\n" + kTriangle + "0 1 0.5\n1 2 nan\n3 0 1 2\n");
  EXPECT_EQ(file.model.polygon_count(), 1U);
}

TEST_F(Ply, StripsBecomeTrianglesThatRunAlike) {
  const auto file = read(kText +
                         "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                         "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 2 1 0\n");
  ASSERT_EQ(file.model.polygon_count(), 3U);
  EXPECT_THAT(file.model.loop(0), ElementsAre(0, 1, 2));
  EXPECT_THAT(file.model.loop(1), ElementsAre(2, 1, 3));
  EXPECT_THAT(file.model.loop(2), ElementsAre(2, 1, 0));
}

TEST_F(Ply, ACommentMayNameTheUnit) {
  EXPECT_EQ(read(kText + "comment units: inches\n" + kVertices + kFaces + kTriangle + "3 0 1 2\n").unit,
            LengthUnit::kInch);
}

TEST_F(Ply, WhatStandsBehindTheLastElementIsReported) {
  EXPECT_THAT(read(kText + kVertices + kFaces + kTriangle + "3 0 1 2\n3 0 1 2\n").notices,
              testing::Contains(HasSubstr("goes on behind its last element")));
}

TEST_F(Ply, BrokenHeadersAreRefusedWithTheirLine) {
  EXPECT_THAT(refusal("plywood\n"), HasSubstr("bowl.ply:1: a PLY file begins with the line ply"));
  EXPECT_THAT(refusal(""), HasSubstr("bowl.ply:1: a PLY file begins"));
  EXPECT_THAT(refusal("ply\nformat utf7 1.0\n"), HasSubstr("bowl.ply:2: 'utf7' is no encoding of PLY"));
  EXPECT_THAT(refusal("ply\nelement vertex 3\nend_header\n"), HasSubstr("the header names no format"));
  EXPECT_THAT(refusal(kText + "element vertex many\n"), HasSubstr("bowl.ply:3: 'many' is no count"));
  EXPECT_THAT(refusal(kText + "element vertex -3\n"), HasSubstr("bowl.ply:3: '-3' is no count"));
  EXPECT_THAT(refusal(kText + "property float x\n"), HasSubstr("bowl.ply:3: this property belongs to no element"));
  EXPECT_THAT(refusal(kText + "element vertex 3\nproperty quad x\n"), HasSubstr("bowl.ply:4: 'quad' is no type"));
  EXPECT_THAT(refusal(kText + "element vertex 3\nproperty list float int x\n"),
              HasSubstr("bowl.ply:4: the count of a list is a whole number"));
  EXPECT_THAT(refusal(kText + "element vertex 9000000000000\nend_header\n"),
              HasSubstr("bowl.ply:3: the element 'vertex' has no properties"));
  EXPECT_THAT(refusal(kText + "element vertex 3\nproperty float x\nend_header\n"),
              HasSubstr("bowl.ply:3: a vertex of this file has no x, y and z"));
  EXPECT_THAT(refusal(kText + kVertices + "element face 1\nproperty int colour\nend_header\n" + kTriangle + "0\n"),
              HasSubstr("bowl.ply:7: a face of this file has no vertex_indices"));
  EXPECT_THAT(refusal(kText + kVertices), HasSubstr("there is no line end_header"));
  EXPECT_THAT(refusal(kText + "wood oak\n"), HasSubstr("bowl.ply:3: 'wood' is no word of a PLY header"));
}

TEST_F(Ply, BrokenTextDataAreRefusedWithTheirLine) {
  const std::string header = kText + kVertices + kFaces;
  EXPECT_THAT(refusal(header + "0 0 0\n1 0 0\n"), HasSubstr("the file ends in vertex 3 of 3"));
  EXPECT_THAT(refusal(header + "0 0 0\n1 0\n"), HasSubstr("bowl.ply:11: this line has 2 numbers"));
  EXPECT_THAT(refusal(header + "0 0 0\n1 0 0 0\n"), HasSubstr("bowl.ply:11: this line has 4 numbers"));
  EXPECT_THAT(refusal(header + "0 0 nan\n"), HasSubstr("bowl.ply:10: 'nan' is no finite number"));
  EXPECT_THAT(refusal(header + kTriangle + "3 0 1\n"), HasSubstr("bowl.ply:13: this line has 3 numbers"));
  EXPECT_THAT(refusal(header + kTriangle + "2 0 1\n"), HasSubstr("bowl.ply:13: a face has at least 3 corners"));
  EXPECT_THAT(refusal(header + kTriangle + "-1 0 1\n"), HasSubstr("bowl.ply:13: -1 is no length of a list"));
  EXPECT_THAT(refusal(header + kTriangle + "3 0 1 -2\n"), HasSubstr("bowl.ply:13: -2 is no vertex"));
  EXPECT_THAT(refusal(header + kTriangle + "3 0 1 1.5\n"), HasSubstr("bowl.ply:13: 1.5 is no vertex"));
  EXPECT_THAT(refusal(header + kTriangle + "3 0 1 3\n"), HasSubstr("bowl.ply:13: vertex 4 does not exist"));
  EXPECT_THAT(refusal(kText + kVertices + "end_header\n" + kTriangle), HasSubstr("there is no face in this model"));
}

TEST_F(Ply, BrokenBinaryDataAreRefusedWithTheirByte) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000000000000\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n";
  EXPECT_THAT(refusal(header + std::string(20, '\0')),
              HasSubstr("bowl.ply: vertex 2 of 4000000000000000000 at byte 145: the file ends here, with 153 bytes"));
  const std::string nan = bytes_of(std::numeric_limits<float>::quiet_NaN(), false);
  EXPECT_THAT(refusal(header + nan + nan + nan),
              HasSubstr("vertex 1 of 4000000000000000000 at byte 133: a coordinate"));
}

}  // namespace
}  // namespace clerestory::io
