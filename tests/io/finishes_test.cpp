// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/finishes.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "tests/support/places.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

std::string named(std::string_view material) {
  const Finish* finish = finish_named_like(material);
  return finish == nullptr ? "" : std::string(finish->name);
}

TEST(Finishes, ThePageInDocsHoldsTheTable) {
  const auto page = test::source_dir() / "docs" / "materials.md";
  const std::string begin = "<!-- the table of finishes -->\n";
  const std::string end = "<!-- end of the table -->\n";
  std::string text = test::read_text(page);
  const std::size_t from = text.find(begin) + begin.size();
  const std::size_t to = text.find(end);
  ASSERT_LE(from, to);
  if (std::getenv("CLERESTORY_UPDATE_DOCS") != nullptr)
    test::write_text(page, text.substr(0, from) + finish_table() + text.substr(to));
  EXPECT_EQ(test::read_text(page).substr(from, finish_table().size()), finish_table())
      << "run this test with CLERESTORY_UPDATE_DOCS=1 to write the table anew";
}

TEST(Finishes, EachNamesASourceThatThePageOfReferencesHas) {
  const std::string references = test::read_text(test::source_dir() / "docs" / "references.bib");
  for (const Finish& finish : finishes()) {
    const std::string key(finish.source.substr(0, finish.source.find_first_of(":;")));
    EXPECT_NE(references.find("{" + key + ","), std::string::npos) << finish.name << ": " << key;
  }
}

TEST(Finishes, NamesAreUniqueAndValuesPossible) {
  std::set<std::string_view> seen;
  for (const Finish& finish : finishes()) {
    EXPECT_TRUE(seen.insert(finish.name).second) << finish.name;
    EXPECT_EQ(find_finish(finish.name), &finish);
    const double share = finish.transmittance_normal.value_or(finish.reflectance + finish.specular);
    EXPECT_GT(share, 0.0) << finish.name;
    EXPECT_LE(share, 0.99) << finish.name;
  }
  EXPECT_EQ(find_finish("unobtainium"), nullptr);
}

TEST(Finishes, AnyPlaceInANameTellsTheFinish) {
  EXPECT_EQ(named("Concrete, cast in place"), "concrete");
  EXPECT_EQ(named("carpet_02"), "carpet");
  EXPECT_EQ(named("FloorOak"), "oak");
  EXPECT_EQ(named("01 Beton"), "concrete");
  EXPECT_EQ(named("Rasen"), "grass");
}

TEST(Finishes, MoreWordsTellMore) {
  EXPECT_EQ(named("Oak - dark"), "dark-oak");
  EXPECT_EQ(named("white tiles"), "white-tiles");
  EXPECT_EQ(named("light wood"), "blond-wood");
  EXPECT_EQ(named("Paint, white"), "white-paint");
}

TEST(Finishes, WhatIsPaintedOrOfAnotherColourIsNotTold) {
  EXPECT_EQ(named("concrete, painted"), "");
  EXPECT_EQ(named("white brick"), "");
  EXPECT_EQ(named("wood wool"), "");
  EXPECT_EQ(named("wallpaper on plaster"), "");
}

TEST(Finishes, PartsOfWordsTellNothing) {
  EXPECT_EQ(named("oakley"), "");
  EXPECT_EQ(named("concretion"), "");
  EXPECT_EQ(named("wall"), "");
  EXPECT_EQ(named(""), "");
}

}  // namespace
}  // namespace clerestory::io
