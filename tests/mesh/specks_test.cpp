// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/specks.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

/// A wall, and a cube of this size before it.
std::vector<Defect> specks_of(double size, double distance, const support::Names& names, std::size_t& left) {
  Model model;
  support::add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3});
  const Point low{1, distance, 1};
  Model cube;
  support::add_quad(cube, low, low + Vector{size, 0, 0}, low + Vector{size, size, 0}, low + Vector{0, size, 0}, names);
  support::append(model, cube);
  Soup soup = to_soup(model);
  DefectList defects;
  remove_specks(soup, defects);
  left = soup.polygons.size();
  return std::move(defects).take({});
}

TEST(Specks, GoWhenTinyAloneAndOfACommonMaterial) {
  std::size_t left = 0;
  EXPECT_EQ(specks_of(2e-4, 0.5, {"wall", "grain"}, left).at(0).mended, 1U);
  EXPECT_EQ(left, 1U);
}

TEST(Specks, AreLeftWhenLargerOrOfTheirOwnMaterial) {
  std::size_t left = 0;
  EXPECT_EQ(specks_of(2e-3, 0.5, {"wall", "grain"}, left).at(0).mended, 0U);
  EXPECT_EQ(left, 2U);
  EXPECT_EQ(specks_of(2e-4, 0.5, {"led", "grain"}, left).at(0).mended, 0U);
  EXPECT_EQ(left, 2U);
}

TEST(Specks, NearAThingAreDetailsOfIt) {
  std::size_t left = 0;
  EXPECT_TRUE(specks_of(2e-4, 1e-4, {"wall", "screw"}, left).empty());
  EXPECT_EQ(left, 2U);
}

TEST(Specks, LargerThanFiveMillimetresAreThings) {
  std::size_t left = 0;
  EXPECT_TRUE(specks_of(6e-3, 0.5, {"wall", "thing"}, left).empty());
}

}  // namespace
}  // namespace clerestory::mesh
