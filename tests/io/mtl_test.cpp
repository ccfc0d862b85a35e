// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mtl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/refusal.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<SourceMaterial> read(const std::string& text) {
  const test::ScratchFolder scratch;
  test::write_text(scratch.path() / "a.mtl", text);
  return read_mtl(scratch.path() / "a.mtl");
}

TEST(Mtl, KeepsNamesWithSpacesAndReadsKd) {
  const auto materials = read("# export\nnewmtl  Oak, white \n  Kd 0.5 0.25 1.0e-1\nnewmtl plain\n");
  ASSERT_EQ(materials.size(), 2U);
  EXPECT_EQ(materials[0].name, "Oak, white");
  EXPECT_THAT(*materials[0].diffuse, ElementsAre(0.5, 0.25, 0.1));
  EXPECT_EQ(materials[0].line, 2U);
  EXPECT_FALSE(materials[1].diffuse.has_value());
}

TEST(Mtl, OneNumberOfKdStandsForAllBands) {
  EXPECT_THAT(*read("newmtl a\nKd 0.4\n")[0].diffuse, ElementsAre(0.4, 0.4, 0.4));
}

TEST(Mtl, SpectralCurvesAndXyzAreNotTakenAsColours) {
  EXPECT_FALSE(read("newmtl a\nKd spectral file.rfl 1\n")[0].diffuse.has_value());
  EXPECT_FALSE(read("newmtl a\nKd xyz 0.1 0.2 0.3\n")[0].diffuse.has_value());
}

TEST(Mtl, OpacityIsDElseOneMinusTr) {
  EXPECT_EQ(read("newmtl a\nd 0.3\n")[0].opacity, 0.3);
  EXPECT_EQ(read("newmtl a\nd -halo 0.3\n")[0].opacity, 0.3);
  EXPECT_EQ(read("newmtl a\nTr 0.75\n")[0].opacity, 0.25);
  EXPECT_EQ(read("newmtl a\nTr 0.75\nd 0.9\n")[0].opacity, 0.9);
  EXPECT_EQ(read("newmtl a\nTr 1\n")[0].opacity, 1.0);
  EXPECT_FALSE(read("newmtl a\nd 0.1\nnewmtl b\n")[1].opacity.has_value());
}

TEST(Mtl, TexturesAndEmissionAreNoticed) {
  const auto material = read("newmtl a\nKd 0 0 0\nmap_Kd oak.png\nKe 1 1 0.5\n")[0];
  EXPECT_TRUE(material.textured);
  EXPECT_TRUE(material.shines);
  EXPECT_FALSE(read("newmtl a\nKe 0 0 0\n")[0].shines);
}

TEST(Mtl, BadNumbersAreRefusedWithTheirLine) {
  const auto refusal = [](const std::string& text) { return test::refusal_of([&] { read(text); }); };
  EXPECT_THAT(refusal("newmtl a\nKd 0.1 nan 0.3\n"), HasSubstr("a.mtl:2: 'nan' is no number"));
  EXPECT_THAT(refusal("newmtl a\nKd 0.1 -0.2 0.3\n"), HasSubstr("a.mtl:2: the colour value -0.2 is below zero"));
  EXPECT_THAT(refusal("newmtl a\nKd 0.1 0.2\n"), HasSubstr("a.mtl:2: a colour has three numbers, this line has 2"));
  EXPECT_THAT(refusal("newmtl a\nd\n"), HasSubstr("a.mtl:2: the number is missing"));
}

}  // namespace
}  // namespace clerestory::io
