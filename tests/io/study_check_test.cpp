// SPDX-License-Identifier: GPL-3.0-or-later
// What is refused in a study, and how: one line with file, line and remedy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/refusal.h"
#include "tests/io/study_folder.h"

namespace clerestory::io {
namespace {

using test::refusal_of;
using test::StudyFolder;
using testing::AllOf;
using testing::HasSubstr;

/// The refusal of a study whose first two lines name the model.
std::string refusal(const std::string& lines, const std::vector<std::string>& set = {}) {
  const StudyFolder folder;
  test::write_text(folder.path() / "bad.pts", "0 0 0 0 0 0\n");
  const std::string text = refusal_of([&] {
    (void)folder.read("[model]\nfile = 'room.obj'\n" + lines,
                      {.kind = lighting::Study::Kind::kIlluminance, .set = set});
  });
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  return text;
}

std::string setting_refusal(const std::string& setting) { return refusal("", {setting}); }

TEST(StudyCheck, UnknownKeysNameTheNearestKnownOne) {
  EXPECT_THAT(refusal("unitz = 'm'\n"),
              HasSubstr("study.toml:3: unknown key 'unitz' in [model]; did you mean 'units'?"));
  EXPECT_THAT(refusal("[materials.wall]\nrefelctance = 0.5\n"),
              HasSubstr("study.toml:4: unknown key 'refelctance' in [materials.wall]; did you mean 'reflectance'?"));
  EXPECT_THAT(refusal("[acuracy]\n"), HasSubstr("did you mean 'accuracy'?"));
  EXPECT_THAT(refusal("[[grids]]\nheigth = 1\n"),
              HasSubstr("study.toml:4: unknown key 'heigth' in [grids.0]; did you mean 'height'?"));
  EXPECT_THAT(refusal("[sky]\nspacing = 1\n"), HasSubstr("it belongs into [[grids]]"));
  EXPECT_THAT(refusal("[accuracy]\nseed = 1\n"), HasSubstr("unknown key 'seed' in [accuracy]"));
}

TEST(StudyCheck, ValuesOutOfRangeAreRefusedWithWhatWasExpected) {
  EXPECT_THAT(refusal("[materials.wall]\nreflectance = 1.2\n"),
              HasSubstr("study.toml:4: materials.wall.reflectance is 1.2, expected a number from 0 up to 0.99, or "
                        "one of them a band: [r, g, b]; write for example reflectance = 0.5"));
  EXPECT_THAT(refusal("[materials.wall]\nreflectance = []\n"), HasSubstr("is a list of 0, expected"));
  EXPECT_THAT(refusal("[materials.wall]\nreflectance = nan\n"), HasSubstr("is nan, expected"));
  EXPECT_THAT(refusal("[[grids]]\nspacing = -0.25\n"), HasSubstr("grids.0.spacing is -0.25, expected a number over 0"));
  EXPECT_THAT(refusal("[[grids]]\nspacing = 'wide'\n"), HasSubstr("or \"en12464\""));
  EXPECT_THAT(refusal("[accuracy]\ntarget = 0\n"), HasSubstr("expected a number from 0.0001 up to 0.5"));
  EXPECT_THAT(refusal("[accuracy]\ntarget = '60%'\n"), HasSubstr("accuracy.target is '60%'"));
  EXPECT_THAT(refusal("[accuracy]\ntarget = '0.0001%'\n"), HasSubstr("from 0.0001 up to 0.5"));
  EXPECT_THAT(refusal("[materials.glass]\nglazing = { transmittance = 0 }\n"),
              HasSubstr("expected a number over 0 up to 1"));
  EXPECT_THAT(refusal("[sky]\nhorizontal_illuminance = 'bright'\n"), HasSubstr("[lux]"));
}

TEST(StudyCheck, ValuesOfTheWrongKindAreRefused) {
  EXPECT_THAT(refusal("north = 'up'\n"), HasSubstr("model.north is 'up', expected a number"));
  EXPECT_THAT(refusal("units = 'yd'\n"), HasSubstr("expected one of m, cm, mm, in, ft"));
  EXPECT_THAT(refusal("[sky]\ntype = 'cie-overkast'\n"), HasSubstr("did you mean \"cie-overcast\"?"));
  EXPECT_THAT(refusal("[grids]\nspacing = 1\n"), HasSubstr("write [[grids]] in double brackets"));
  EXPECT_THAT(refusal("materials = 3\n"),
              HasSubstr("unknown key 'materials' in [model]; [materials] is a table of its own"));
  EXPECT_THAT(refusal("[materials]\nwall = 0.5\n"), HasSubstr("materials.wall is 0.5, expected a table"));
  EXPECT_THAT(refusal("[[grids]]\nsurface = []\n"), HasSubstr("grids.0.surface is a list of 0"));
}

TEST(StudyCheck, WhatThisVersionCannotDoIsRefusedAndNotIgnored) {
  for (const char* lines : {"[materials.wall]\ntranslucent = { transmittance = 0.3 }\n"})
    EXPECT_THAT(refusal(lines), AllOf(HasSubstr("study.toml:"), HasSubstr("is not supported by this version")))
        << lines;
  EXPECT_EQ(refusal("[sky]\nsun = false\ndirect_normal = 0\n"), "accepted");
}

TEST(StudyCheck, TruncatedStudiesAreRefusedWithTheirLine) {
  EXPECT_THAT(refusal("[materials.wall\n"), HasSubstr("study.toml:3: "));
  EXPECT_THAT(refusal("[sky]\ntype = \"cie-over"), HasSubstr("study.toml:4: "));
  EXPECT_THAT(refusal("[sky]\ntype ="), HasSubstr("study.toml:4: "));
  EXPECT_THAT(refusal("[sky]\ntype = '\xff\xfe'\n"), HasSubstr("study.toml:4: "));
  EXPECT_THAT(refusal("north = " + std::string(100'000, '[')), HasSubstr("study.toml:3: "));
}

TEST(StudyCheck, MaterialsThatTheModelDoesNotHaveAreRefused) {
  EXPECT_THAT(refusal("[materials.wal]\nreflectance = 0.5\n"),
              HasSubstr("study.toml:3: no material of the model is named 'wal'; did you mean \"wall\"?"));
  EXPECT_THAT(refusal("[materials.'x*']\nreflectance = 0.5\n"), HasSubstr("it has floor, wall, glass"));
}

TEST(StudyCheck, MaterialsThatContradictThemselvesAreRefused) {
  EXPECT_THAT(refusal("[materials.wall]\nreflectance = 0.5\nglazing = {}\n"),
              HasSubstr("cannot have reflectance beside glazing"));
  EXPECT_THAT(refusal("[materials.wall]\nopening = true\nreflectance = 0.5\n"),
              HasSubstr("cannot have reflectance beside opening"));
  EXPECT_THAT(refusal("[materials.wall]\nemission = {}\n"), HasSubstr("give flux_lm or luminance_cd_m2"));
  EXPECT_THAT(refusal("[materials.wall]\nemission = { flux_lm = 1, luminance_cd_m2 = 1 }\n"), HasSubstr("gives both"));
  EXPECT_THAT(refusal("[materials.wall]\nreflectance = 0.5\nspecular = { reflectance = 0.6 }\n"),
              HasSubstr("reflects 1.10 in all"));
  EXPECT_THAT(refusal("[materials.wall]\nspecular = { reflectance = 0.6 }\n"), HasSubstr("give reflectance beside it"));
}

TEST(StudyCheck, GridsNeedNamesThatNameFiles) {
  for (const char* name : {"", "a/b", "..", ".hidden", "a:b", "con\\t", "tab\\t", " a"})
    EXPECT_THAT(refusal("[[grids]]\nname = \"" + std::string(name) + "\"\n"), HasSubstr("cannot name a file")) << name;
  EXPECT_THAT(refusal("[[grids]]\nname = 'Surfaces'\n"), HasSubstr("belongs to another result"));
  EXPECT_THAT(refusal("[[grids]]\n[[grids]]\n"), HasSubstr("study.toml:4: two grids have the name 'workplane'"));
  EXPECT_THAT(refusal("[[grids]]\nname = 'a'\n[[grids]]\nname = 'A'\n"), HasSubstr("two grids have the name 'A'"));
}

TEST(StudyCheck, GridsNeedSurfacesAndFilesThatAreThere) {
  EXPECT_THAT(refusal("[[grids]]\nsurface = 'flor'\n"),
              HasSubstr("study.toml:4: the model has no part and no material 'flor'; did you mean \"floor\"?"));
  EXPECT_THAT(refusal("[[grids]]\nsurface = ['floor', 'q*']\n"), HasSubstr("it has box, floor, glass, wall"));
  EXPECT_THAT(refusal("[[grids]]\npoints = 'none.pts'\n"), HasSubstr("study.toml:4: there is no sensor file"));
  EXPECT_THAT(refusal("[[grids]]\npoints = 'bad.pts'\n"), HasSubstr("bad.pts:1: the normal"));
  EXPECT_THAT(refusal("[[grids]]\npoints = 'bad.pts'\nspacing = 1\n"),
              HasSubstr("study.toml:5: a grid of given points has no spacing"));
}

TEST(StudyCheck, OverridesAreCheckedLikeTheFile) {
  EXPECT_THAT(setting_refusal("model.unit=mm"),
              HasSubstr("--set model.unit=mm: unknown key 'unit' in [model]; did you mean 'units'?"));
  EXPECT_THAT(setting_refusal("accuracy.target=60%"), HasSubstr("--set accuracy.target=60%: accuracy.target is '60%'"));
  EXPECT_THAT(setting_refusal("accuracy"), HasSubstr("this is no setting; write --set table.key=value"));
  EXPECT_THAT(setting_refusal("=3"), HasSubstr("this is no setting"));
  EXPECT_THAT(setting_refusal("a..b=3"), HasSubstr("this is no setting"));
  EXPECT_THAT(setting_refusal("accuracy.target="), HasSubstr("the value is missing"));
  EXPECT_THAT(setting_refusal("grids.5.spacing=1"), HasSubstr("'5' is no item of it"));
  EXPECT_THAT(setting_refusal("model.file.name=1"), HasSubstr("'file' is no table"));
  EXPECT_THAT(setting_refusal("sky.type=\"none"), HasSubstr("--set sky.type="));
  EXPECT_THAT(setting_refusal("sky.type=none\nsun=true"), HasSubstr("--set sky.type=none"));
}

/// What is said of a grid in the place of the study's.
std::string grid_refusal(const std::string& keys) {
  const StudyFolder folder;
  return refusal_of([&] { (void)folder.read("[model]\nfile = 'room.obj'\n", {.set = {}, .grids = {keys}}); });
}

TEST(StudyCheck, GridsInThePlaceOfTheStudysAreCheckedByTheirOwnWords) {
  const StudyFolder folder;
  const auto study = folder
                         .read("[model]\nfile = 'room.obj'\n[[grids]]\nname = 'a'\n",
                               {.set = {}, .grids = {"name = 'b', height = 1.0", "name = 'c'"}})
                         .study;
  ASSERT_EQ(study.grids.size(), 2U);
  EXPECT_EQ(study.grids[0].name, "b");
  EXPECT_EQ(study.grids[0].height_m, 1.0);
  EXPECT_THAT(grid_refusal("nane = 'b'"), HasSubstr("--grid nane = 'b': unknown key 'nane'"));
  EXPECT_THAT(grid_refusal("name = b"), HasSubstr("write keys of [[grids]], as in --grid"));
  EXPECT_THAT(grid_refusal("name = 'b', spacing = -1"), testing::Not(HasSubstr("--set")));
}

TEST(StudyCheck, ModelsThatAreNotThereAreRefusedAtTheirKey) {
  const StudyFolder folder;
  const auto refused = [&](const std::string& text) { return refusal_of([&] { (void)folder.read(text); }); };
  EXPECT_THAT(refused(""), HasSubstr("study.toml: the study names no model"));
  EXPECT_THAT(refused("[model]\nunits = 'm'\n"), HasSubstr("study.toml:1: the study names no model"));
  EXPECT_THAT(refused("[model]\nfile = 'rom.obj'\n"), HasSubstr("study.toml:2: there is no model"));
  EXPECT_THAT(refusal_of([&] { (void)read_study(folder.path() / "none.toml"); }),
              HasSubstr("none.toml: there is no such study"));
  EXPECT_THAT(refusal_of([&] { (void)read_study(folder.path()); }), HasSubstr("this is a folder"));
  EXPECT_THAT(refusal_of([&] { (void)read_study(folder.path() / "room.mtl"); }), HasSubstr("is no model"));
}

}  // namespace
}  // namespace clerestory::io
