// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/stl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "tests/io/refusal.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using Triangle = std::array<float, 9>;

std::string bytes_of(float value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// A binary STL that promises `count` triangles and has those given. Tests run on little-endian machines.
std::string binary(std::uint32_t count, const std::vector<Triangle>& triangles, const std::string& header = "solid") {
  std::string text = header;
  text.resize(80, ' ');
  for (unsigned shift = 0; shift < 32; shift += 8) text += static_cast<char>(count >> shift);
  for (const Triangle& triangle : triangles) {
    text += std::string(12, '\0');
    for (const float x : triangle) text += bytes_of(x);
    text += std::string(2, '\0');
  }
  return text;
}

std::string facet(const std::string& corners, const std::string& normal = "0 0 1") {
  return "facet normal " + normal + "\n outer loop\n" + corners + " endloop\nendfacet\n";
}

const std::string kCorners = "  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n";

class Stl : public testing::Test {
 protected:
  ModelFile read(const std::string& text) {
    test::write_text(path(), text);
    return read_stl(path());
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { read(text); });
  }
  std::filesystem::path path() const { return scratch_.path() / "chair.stl"; }

 private:
  test::ScratchFolder scratch_;
};

TEST_F(Stl, SolidsAreParts) {
  const auto file = read("solid left leg \n" + facet(kCorners) + "endsolid left leg\nsolid\n" + facet(kCorners) +
                         "endsolid\nsolid empty\nendsolid");
  EXPECT_THAT(file.model.part_names, ElementsAre("left leg", "chair"));
  EXPECT_EQ(file.model.polygon_count(), 2U);
}

TEST_F(Stl, FacetsThatShareCoordinatesShareVertices) {
  const std::string other = "vertex 1 0 0\nvertex 0 1 -0.0\nvertex 1 1 0\n";
  EXPECT_EQ(read("solid\n" + facet(kCorners) + facet(other) + "endsolid").model.vertices.size(), 4U);
  EXPECT_EQ(read(binary(2, {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 0, 1, -0.0F, 1, 1, 0}})).model.vertices.size(), 4U);
}

TEST_F(Stl, LargeCoordinatesOfTextComeBackAsTheNearestDouble) {
  const auto file =
      read("solid\n" + facet("vertex 612345.123456 5412345.654321 0.1\nvertex 1 0 0\nvertex 0 1 0\n") + "endsolid");
  EXPECT_EQ(file.model.vertices[0], (mesh::Point{612345.123456, 5412345.654321, 0.1}));
}

TEST_F(Stl, WordsMayStandInAnyCaseOnAnyLineAndNormalsMayBeNaN) {
  const auto file = read(
      "SOLID a\nFACET NORMAL nan -nan(ind) 1.#QNAN OUTER LOOP VERTEX 0 0 0 Vertex 1 0 0\nvertex 0 1\n"
      "0 endloop endfacet ENDSOLID a\n");
  EXPECT_EQ(file.model.polygon_count(), 1U);
}

TEST_F(Stl, SizeTellsBinaryFromTextWhateverTheHeaderSays) {
  const auto file = read(binary(1, {{0, 0, 0, 2.5, 0, 0, 0, 1, 0}}, "solid facet normal endsolid"));
  ASSERT_EQ(file.model.polygon_count(), 1U);
  EXPECT_EQ(file.model.vertices[1], (mesh::Point{2.5, 0.0, 0.0}));
  EXPECT_THAT(file.model.part_names, ElementsAre("chair"));
}

TEST_F(Stl, BytesBehindTheLastTriangleAreReported) {
  EXPECT_THAT(read(binary(1, {{0, 0, 0, 1, 0, 0, 0, 1, 0}}) + std::string(7, '\0')).notices,
              testing::Contains(HasSubstr("7 bytes behind the last triangle")));
}

TEST_F(Stl, BrokenTextIsRefusedWithItsLine) {
  EXPECT_THAT(refusal(""), HasSubstr("chair.stl: the file ends where solid should follow"));
  EXPECT_THAT(refusal("v 0 0 0\n"), HasSubstr("chair.stl:1: 'v' stands where solid should"));
  EXPECT_THAT(refusal("solid\nendsolid\n"), HasSubstr("there is no face in this model"));
  EXPECT_THAT(refusal("solid\n" + facet(kCorners)), HasSubstr("chair.stl:8: the file ends inside a solid"));
  EXPECT_THAT(refusal("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0"),
              HasSubstr("chair.stl:4: the file ends inside a vertex"));
  EXPECT_THAT(refusal("solid\n" + facet("vertex 0 x 0\n")), HasSubstr("chair.stl:4: the coordinate 'x'"));
  EXPECT_THAT(refusal("solid\n" + facet("vertex 0 nan 0\n")), HasSubstr("chair.stl:4: the coordinate 'nan'"));
  EXPECT_THAT(refusal("solid\n" + facet("vertex 0 0 0\nvertex 1 0 0\n")),
              HasSubstr("chair.stl:7: a facet has at least 3 corners, this one has 2"));
  EXPECT_THAT(refusal("solid\n" + facet(kCorners) + "endsolid\nrubbish"),
              HasSubstr("chair.stl:10: 'rubbish' stands where a solid should begin"));
}

TEST_F(Stl, BrokenBinaryIsRefusedWithItsByte) {
  EXPECT_THAT(refusal(binary(3, {{0, 0, 0, 1, 0, 0, 0, 1, 0}})),
              HasSubstr("chair.stl: the file ends at byte 134, in triangle 2 of 3"));
  EXPECT_THAT(refusal(binary(4000000000U, {})), HasSubstr("in triangle 1 of 4000000000"));
  EXPECT_THAT(refusal(std::string(50, '\0')), HasSubstr("begins with 84 bytes, this file has 50"));
  EXPECT_THAT(refusal(binary(2, {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0, NAN, 0, 0, 0, 1, 0}})),
              HasSubstr("chair.stl: triangle 2 at byte 134: a vertex has a coordinate that is no finite number"));
}

}  // namespace
}  // namespace clerestory::io
