// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/study_file.h"
#include "mesh/curvature.h"
#include "mesh/error.h"
#include "tests/io/study_folder.h"

namespace clerestory {
namespace {

using testing::HasSubstr;

/// A folder with a cage in two parts, "vault" of quads and "leg", and a tag where asked for.
class CageFolder {
 public:
  explicit CageFolder(const std::string& tags = {}) {
    test::write_text(scratch_.path() / "cage.obj",
                     "o vault\nv 0 0 0\nv 1 0 0.5\nv 2 0 0\nv 0 1 0\nv 1 1 0.5\nv 2 1 0\nv 0 2 0\nv 1 2 0.5\nv 2 2 0\n"
                     "f 1 2 5 4\nf 2 3 6 5\nf 4 5 8 7\nf 5 6 9 8\no leg\nv 5 0 0\nv 6 0 0\nv 6 1 0\nf 10 11 12\n" +
                         tags);
  }
  [[nodiscard]] io::StudyInput read(const std::string& parts) const {
    test::write_text(scratch_.path() / "s.toml", "[model]\nfile = 'cage.obj'\nunits = 'm'\n" + parts);
    return io::read_study(scratch_.path() / "s.toml", {.set = {}, .model_only = true});
  }
  [[nodiscard]] std::string refusal(const std::string& parts) const {
    try {
      (void)read(parts);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

 private:
  test::ScratchFolder scratch_;
};

TEST(StudyParts, AMarkedPartIsReplacedByItsLimitSurface) {
  const io::StudyInput input =
      CageFolder().read("[parts.\"va*\"]\nsubdivision = 'catmull-clark'\nchord_tolerance = 0.01\n");
  ASSERT_EQ(input.curved.parts.size(), 1U);
  EXPECT_EQ(input.curved.parts[0].cage_faces, 4U);
  EXPECT_EQ(input.curved.parts[0].facets + 1, input.study.model.polygon_count());
  EXPECT_DOUBLE_EQ(input.curved.parts[0].chord_tolerance_m, 0.01);
  EXPECT_LE(input.curved.parts[0].deviation_m, 0.01);
  EXPECT_NE(input.study.model.curvature, nullptr);
}

TEST(StudyParts, WithoutAMarkNothingIsCurved) {
  const io::StudyInput input = CageFolder().read("");
  EXPECT_TRUE(input.curved.parts.empty());
  EXPECT_EQ(input.study.model.polygon_count(), 5U);
}

TEST(StudyParts, TagsOfTheFileMarkAndTheStudyOverrules) {
  const CageFolder folder("t crease 2/1/0 4 1 3.0\n");
  EXPECT_EQ(folder.read("").curved.parts.size(), 1U);
  EXPECT_TRUE(folder.read("[parts.vault]\nsubdivision = 'none'\n").curved.parts.empty());
}

TEST(StudyParts, FaultsAreToldWithFileAndLine) {
  const CageFolder folder;
  EXPECT_THAT(folder.refusal("[parts.vault]\nsubdivision = 'loop'\n"), HasSubstr("cage.obj:11: part 'vault'"));
  EXPECT_THAT(folder.refusal("[parts.vaul]\nsubdivision = 'loop'\n"), HasSubstr("s.toml:4"));
  EXPECT_THAT(folder.refusal("[parts.vaul]\nsubdivision = 'loop'\n"), HasSubstr("did you mean \"vault\"?"));
  EXPECT_THAT(folder.refusal("[parts.vault]\nsubdivision = 'catmul-clark'\n"),
              HasSubstr("did you mean \"catmull-clark\"?"));
}

}  // namespace
}  // namespace clerestory
