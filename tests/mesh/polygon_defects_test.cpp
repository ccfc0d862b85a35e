// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/polygon_defects.h"

#include <gtest/gtest.h>

#include "mesh/weld.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

Soup welded(const Model& model) {
  Soup soup = to_soup(model);
  DefectList ignored;
  weld(soup, 2e-5, ignored);
  return soup;
}

TEST(DropDegenerate, DropsPolygonsNarrowerThanTheTolerance) {
  Model model;
  support::add_triangle(model, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  support::add_quad(model, {0, 0, 0}, {5, 0, 0}, {5, 1e-5, 0}, {0, 1e-5, 0});
  support::add_quad(model, {0, 0, 0}, {5, 0, 0}, {5, 1e-3, 0}, {0, 1e-3, 0});
  Soup soup = welded(model);
  DefectList defects;
  EXPECT_TRUE(drop_degenerate(soup, 2e-5, defects));
  ASSERT_EQ(soup.polygons.size(), 1U);
  EXPECT_EQ(soup.polygons[0].source, 2U);
  EXPECT_EQ(std::move(defects).take({})[0].found, 2U);
}

TEST(DropDegenerate, DropsHolesOfNoAreaAlone) {
  Model model;
  support::add_polygon(model, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {},
                       {{{1, 1, 0}, {2, 1, 0}, {3, 1, 0}}, {{1, 2, 0}, {1, 3, 0}, {2, 3, 0}}});
  Soup soup = welded(model);
  DefectList defects;
  drop_degenerate(soup, 2e-5, defects);
  ASSERT_EQ(soup.polygons.size(), 1U);
  EXPECT_EQ(soup.polygons[0].loops.size(), 2U);
}

TEST(DropDegenerate, SurvivesAPolygonWithoutCorners) {
  Model model = support::facing_squares();
  model.begin_polygon(MaterialId(0U), PartId(0U));
  Soup soup = to_soup(model);
  DefectList defects;
  drop_degenerate(soup, 2e-5, defects);
  EXPECT_EQ(soup.polygons.size(), 2U);
}

TEST(DropDuplicates, KeepsTheFirstOfEitherWinding) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {"wood", "a"});
  support::add_quad(model, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {"wood", "b"});
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {"stone", "c"});
  support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {"wood", "d"});
  Soup soup = welded(model);
  DefectList list;
  drop_duplicates(soup, {model.material_names, {}}, list);
  ASSERT_EQ(soup.polygons.size(), 2U);
  EXPECT_EQ(soup.polygons[0].source, 0U);
  EXPECT_EQ(soup.polygons[1].source, 3U);
  const std::vector<Defect> defects = std::move(list).take({});
  ASSERT_EQ(defects.size(), 2U);
  EXPECT_EQ(defects[0].kind, "duplicate polygons");
  EXPECT_EQ(defects[1].kind, "duplicate polygons of different material");
  EXPECT_EQ(defects[1].places[0].note, "wood kept, stone dropped");
}

/// A quad of wood and one of stone that lies on it the other way round, the two in either order.
Model back_to_back(bool stone_first) {
  Model model;
  const auto wood = [&] { support::add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {"wood", "a"}); };
  if (!stone_first) wood();
  support::add_quad(model, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}, {"stone", "b"});
  if (stone_first) wood();
  return model;
}

TEST(DropDuplicates, BackToBackEachSideKeepsItsMaterial) {
  for (const bool stone_first : {false, true}) {
    const Model model = back_to_back(stone_first);
    Soup soup = welded(model);
    DefectList list;
    drop_duplicates(soup, {model.material_names, {}}, list);
    ASSERT_EQ(soup.polygons.size(), 1U);
    const SoupPolygon& kept = soup.polygons[0];
    EXPECT_EQ(model.material_names[kept.material.index()], stone_first ? "stone" : "wood");
    EXPECT_EQ(model.material_names[kept.back_material.index()], stone_first ? "wood" : "stone");
    EXPECT_TRUE(std::move(list).take({}).empty()) << "nothing is lost, so that it is no defect";
  }
}

TEST(DropDuplicates, WhatLightPassesHasNoOtherBack) {
  const Model model = back_to_back(false);
  const std::vector<bool> stone_passes = {false, true};
  Soup soup = welded(model);
  DefectList list;
  drop_duplicates(soup, {model.material_names, stone_passes}, list);
  ASSERT_EQ(soup.polygons.size(), 1U);
  EXPECT_FALSE(soup.polygons[0].back_material.valid());
  EXPECT_EQ(std::move(list).take({})[0].kind, "duplicate polygons of different material");
}

TEST(DropDuplicates, TheFirstOfSeveralBacksStays) {
  Model model = back_to_back(false);
  support::add_quad(model, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}, {"brick", "c"});
  Soup soup = welded(model);
  DefectList list;
  drop_duplicates(soup, {model.material_names, {}}, list);
  ASSERT_EQ(soup.polygons.size(), 1U);
  EXPECT_EQ(model.material_names[soup.polygons[0].back_material.index()], "stone");
  const std::vector<Defect> defects = std::move(list).take({});
  ASSERT_EQ(defects.size(), 1U);
  EXPECT_EQ(defects[0].places.at(0).note, "wood kept, brick dropped");
}

}  // namespace
}  // namespace clerestory::mesh
