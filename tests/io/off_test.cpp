// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/off.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/refusal.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kTriangle = "0 0 0\n1 0 0\n0 1 0\n";

class Off : public testing::Test {
 protected:
  ModelFile read(const std::string& text) {
    test::write_text(path(), text);
    return read_off(path());
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { read(text); });
  }
  std::filesystem::path path() const { return scratch_.path() / "lamp.off"; }

 private:
  test::ScratchFolder scratch_;
};

TEST_F(Off, FacesKeepTheirCornersAndTheirLine) {
  const auto file =
      read("OFF\n# a lamp\n4 1 0\n\n612345.123456 5412345.654321 0.1 # first\n1 0 0\n1 1 0\n0 1 0\n4 3 2 1 0\n");
  EXPECT_EQ(file.model.vertices[0], (mesh::Point{612345.123456, 5412345.654321, 0.1}));
  EXPECT_THAT(file.model.loop(0), ElementsAre(3, 2, 1, 0));
  EXPECT_EQ(file.model.polygon_line[0], 9U);
  EXPECT_THAT(file.model.part_names, ElementsAre("lamp"));
}

TEST_F(Off, ColoursNormalsAndTextureCoordinatesArePassedOver) {
  for (const char* word : {"COFF", "NOFF", "STOFF", "CNOFF", "STCNOFF"}) {
    const auto file =
        read(std::string(word) + "\n3 1 3\n0 0 0 9 9 9 1\n1 0 0 9 9 9 1\n0 1 0 9 9 9 1\n3 0 1 2 255 0 0\n");
    EXPECT_EQ(file.model.polygon_count(), 1U) << word;
    EXPECT_EQ(file.model.vertices.size(), 3U) << word;
  }
}

TEST_F(Off, TheWordMayBeMissingOrGluedToTheCounts) {
  EXPECT_EQ(read("3 1 0\n" + kTriangle + "3 0 1 2\n").model.polygon_count(), 1U);
  EXPECT_EQ(read("OFF3 1 0\n" + kTriangle + "3 0 1 2\n").model.polygon_count(), 1U);
  EXPECT_EQ(read("OFF 3 1\n" + kTriangle + "3 0 1 2\n").model.polygon_count(), 1U);
}

TEST_F(Off, PointsLinesAndWhatFollowsAreReported) {
  const auto file = read("OFF\n3 3 0\n" + kTriangle + "1 0\n2 0 1\n3 0 1 2\n3 2 1 0\n");
  EXPECT_EQ(file.model.polygon_count(), 1U);
  EXPECT_THAT(file.notices, Contains(HasSubstr("2 points and lines of the model were left out")));
  EXPECT_THAT(file.notices, Contains(HasSubstr("goes on behind its last face, from line 9")));
}

TEST_F(Off, BrokenFilesAreRefusedWithTheirLine) {
  EXPECT_THAT(refusal(""), HasSubstr("lamp.off: there is nothing in this file"));
  EXPECT_THAT(refusal("OFF BINARY\n"), HasSubstr("lamp.off:1: this OFF is binary"));
  EXPECT_THAT(refusal("4OFF\n3 1 0\n"), HasSubstr("lamp.off:1: 4OFF has other than three dimensions"));
  EXPECT_THAT(refusal("OFF\n"), HasSubstr("the file ends before its counts"));
  EXPECT_THAT(refusal("OFF\n3\n"), HasSubstr("lamp.off:2: the counts of vertices and faces"));
  EXPECT_THAT(refusal("OFF\n-3 1 0\n"), HasSubstr("lamp.off:2: '-3' is no count"));
  EXPECT_THAT(refusal("OFF\n8000000000000 1 0\n" + kTriangle), HasSubstr("the file ends in vertex 4 of 8000000000000"));
  EXPECT_THAT(refusal("OFF\n3 2 0\n" + kTriangle + "3 0 1 2\n"), HasSubstr("the file ends in face 2 of 2"));
  EXPECT_THAT(refusal("OFF\n3 1 0\n0 0\n"), HasSubstr("lamp.off:3: a vertex has three coordinates"));
  EXPECT_THAT(refusal("OFF\n3 1 0\n0 0 inf\n"), HasSubstr("lamp.off:3: the coordinate 'inf'"));
  const std::string start = "OFF\n3 1 0\n" + kTriangle;
  EXPECT_THAT(refusal(start + "3 0 1 3\n"),
              HasSubstr("lamp.off:6: vertex 3 does not exist: the model has 3, counted from 0"));
  EXPECT_THAT(refusal(start + "4 0 1 2\n"), HasSubstr("lamp.off:6: this face promises 4 corners and has 3"));
  EXPECT_THAT(refusal(start + "0\n"), HasSubstr("lamp.off:6: a face has at least one corner"));
  EXPECT_THAT(refusal(start + "3 0 1 -1\n"), HasSubstr("lamp.off:6: '-1' is no vertex"));
}

}  // namespace
}  // namespace clerestory::io
