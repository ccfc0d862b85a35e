// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/obj_tags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/obj.h"
#include "mesh/error.h"
#include "tests/io/study_folder.h"

namespace clerestory {
namespace {

using testing::HasSubstr;

constexpr const char* kSquares =
    "o a\nv 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 2 3 4 5\no b\nf 3 6 7 4\n";

io::ModelFile read(const std::string& tags) {
  const test::ScratchFolder folder;
  test::write_text(folder.path() / "cage.obj", kSquares + tags);
  return io::read_obj(folder.path() / "cage.obj");
}

std::string refusal(const std::string& tag) {
  try {
    read(tag);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ObjTags, CreasesCornersAndHolesCountFromZeroOverTheFile) {
  const mesh::Model model = read("t crease 4/2/0 2 3 1 2 3.5 12\nt corner 1/1/0 4 0.7\nt hole 1/0/0 1\n").model;
  // The first vertex is used by no face, so that those behind it move up.
  ASSERT_EQ(model.tags.creases.size(), 2U);
  EXPECT_EQ(model.tags.creases[0].edge, (std::array<std::uint32_t, 2>{1, 2}));
  EXPECT_FLOAT_EQ(model.tags.creases[0].sharpness, 3.5F);
  EXPECT_FLOAT_EQ(model.tags.creases[1].sharpness, 10.0F);
  ASSERT_EQ(model.tags.corners.size(), 1U);
  EXPECT_EQ(model.tags.corners[0].vertex, 3U);
  EXPECT_EQ(model.tags.holes, std::vector<std::uint32_t>{1});
}

TEST(ObjTags, RulesHoldForThePartInWhichTheyStand) {
  const mesh::Model model =
      read("t interpolateboundary 1/0/0 2\nt creasemethod 0/0/1 chaikin\nt smoothtriangles 0/0/1 smooth\n").model;
  ASSERT_EQ(model.tags.rules.size(), 1U);
  EXPECT_EQ(model.part_names[model.tags.rules[0].part.index()], "b");
  const mesh::SubdivisionRules& rules = model.tags.rules[0].rules;
  EXPECT_EQ(rules.boundary, mesh::SubdivisionRules::Boundary::kEdgeOnly);
  EXPECT_TRUE(rules.chaikin_creases);
  EXPECT_TRUE(rules.smooth_triangles);
}

TEST(ObjTags, TagsOfTexturesArePassedOverAndOtherOnesTold) {
  EXPECT_TRUE(read("t facevaryinginterpolateboundary 1/0/0 1\n").model.tags.empty());
  const io::ModelFile file = read("t vertexedit 1/1/1 3 0.1 add\n");
  EXPECT_TRUE(file.model.tags.empty());
  EXPECT_THAT(file.notices, testing::Contains(HasSubstr("1 subdivision tags of the model are not known")));
}

TEST(ObjTags, WhatIsNoTagIsRefusedWithItsLine) {
  EXPECT_THAT(refusal("t crease 2/1/0 1 2\n"), HasSubstr("cage.obj:12: the tag has 2 arguments, and says 2/1/0"));
  EXPECT_THAT(refusal("t crease 3/1/0 1 2 3 1.0\n"), HasSubstr("pairs of vertices"));
  EXPECT_THAT(refusal("t crease 2/1/0 1 7 1.0\n"), HasSubstr("vertex 7 does not exist"));
  EXPECT_THAT(refusal("t crease 2/1/0 1 2 nan\n"), HasSubstr("no finite number"));
  EXPECT_THAT(refusal("t crease 2/1/0 1 2 -1\n"), HasSubstr("means nothing"));
  EXPECT_THAT(refusal("t hole 1/0/0 2\n"), HasSubstr("face 2 does not exist"));
  EXPECT_THAT(refusal("t hole x/0/0 1\n"), HasSubstr("does not count"));
  EXPECT_THAT(refusal("t hole\n"), HasSubstr("has a name and counts"));
  EXPECT_THAT(refusal("t interpolateboundary 1/0/0 3\n"), HasSubstr("boundary rule"));
  EXPECT_THAT(refusal("t creasemethod 0/0/1 round\n"), HasSubstr("normal or chaikin"));
}

}  // namespace
}  // namespace clerestory
