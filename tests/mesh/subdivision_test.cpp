// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/subdivision.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "mesh/curvature.h"
#include "mesh/error.h"
#include "tests/support/cages.h"
#include "tests/support/shapes.h"

namespace clerestory {
namespace {

using mesh::CurvedPart;
using mesh::SubdivisionScheme;
using testing::HasSubstr;

using Parts = std::vector<std::optional<CurvedPart>>;

/// The line and the problem of what is refused.
std::string refusal(const mesh::Model& model, const CurvedPart& part = {}) {
  try {
    mesh::subdivide(model, Parts(model.part_names.size(), part));
  } catch (const InputError& error) {
    return std::to_string(error.line()) + ": " + error.problem() + "; " + error.hint();
  }
  return "accepted";
}

TEST(Subdivision, OtherPartsStayAsTheyAre) {
  mesh::Model model = support::box_room(4.0, 5.0, 3.0);
  const std::size_t flat = model.polygon_count();
  support::append(model, support::cube_cage());
  Parts parts(model.part_names.size());
  parts.back() = CurvedPart{};
  const mesh::Model result = mesh::subdivide(model, parts);
  ASSERT_GT(result.polygon_count(), flat + 6);
  for (std::size_t p = 0; p < flat; ++p) {
    EXPECT_EQ(result.curvature->facet_of[p], mesh::Curvature::kFlat);
    ASSERT_EQ(result.loop(p).size(), model.loop(p).size());
    for (std::size_t k = 0; k < model.loop(p).size(); ++k)
      EXPECT_EQ(result.vertices[result.loop(p)[k]], model.vertices[model.loop(p)[k]]);
  }
  // The cage's own corners are gone.
  for (const mesh::Point& p : result.vertices) EXPECT_NE(p, (mesh::Point{1, 1, 1}));
}

TEST(Subdivision, PiecesKeepMaterialPartAndLineOfTheirPolygon) {
  const mesh::Model model = support::cube_cage();
  const mesh::Model result = support::curved(model, 0.01);
  EXPECT_EQ(result.polygon_line.front(), 1U);
  EXPECT_EQ(result.polygon_line.back(), 6U);
  EXPECT_TRUE(std::is_sorted(result.polygon_line.begin(), result.polygon_line.end()));
}

TEST(Subdivision, APointOfAFacetStandsForAPointOfTheLimitSurface) {
  const mesh::Model result = support::curved(support::irregular_cage(), 0.01);
  for (std::size_t p = 0; p < result.polygon_count(); ++p) {
    const std::uint32_t facet = result.curvature->facet_of[p];
    const auto& corners = result.curvature->facets[facet].corners;
    const mesh::Vector own = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT(norm(result.curvature->limit(facet, corners[k]).at - corners[k]), 1e-9);
      const mesh::Point middle = midpoint(corners[k], corners[(k + 1) % 3]);
      EXPECT_LE(std::abs(dot(result.curvature->limit(facet, middle).at - middle, own)), 0.01 + 1e-12);
    }
    const mesh::Point centre = corners[0] + ((corners[1] - corners[0]) + (corners[2] - corners[0])) / 3.0;
    EXPECT_GT(dot(result.curvature->limit(facet, centre).normal, own), 0.95);
  }
}

TEST(Subdivision, VerticesAtOnePlaceAreOneWithinAPart) {
  mesh::Model model;
  // Every polygon has vertices of its own here.
  support::add_box(model, {-1, -1, -1}, {1, 1, 1});
  EXPECT_EQ(support::whole_cage(model).points.size(), 8U);
}

TEST(Subdivision, TheDefaultToleranceFollowsTheSizeOfThePart) {
  EXPECT_DOUBLE_EQ(mesh::default_chord_tolerance({{0, 0, 0}, {0.3, 0.4, 0.0}}), 0.001);
  EXPECT_DOUBLE_EQ(mesh::default_chord_tolerance({{0, 0, 0}, {6, 8, 0}}), 0.00375);
  EXPECT_DOUBLE_EQ(mesh::default_chord_tolerance({{0, 0, 0}, {0.003, 0.004, 0}}), 1e-4);
}

TEST(Subdivision, TagsMarkTheirParts) {
  mesh::Model model = support::box_room(4.0, 5.0, 3.0);
  support::append(model, support::cube_cage());
  const std::size_t last = model.part_names.size() - 1;
  EXPECT_FALSE(mesh::tagged_parts(model)[last]);
  const auto top = model.loop(model.polygon_count() - 5);
  model.tags.creases.push_back({{top[0], top[1]}, 3.0F});
  EXPECT_TRUE(mesh::tagged_parts(model)[last]);
  EXPECT_FALSE(mesh::tagged_parts(model)[0]);
}

TEST(Subdivision, EdgesOfThreeFacesAreMadeSharpAndTold) {
  mesh::Model model = support::cube_cage();
  model.vertices.push_back({2, 0, 2});
  model.begin_polygon(mesh::MaterialId(0U), mesh::PartId(0U), 7);
  model.add_loop(std::vector<std::uint32_t>{5, 6, 8});
  mesh::SubdivisionReport report;
  mesh::subdivide(model, Parts(1, CurvedPart{}), &report);
  ASSERT_EQ(report.notices.size(), 1U);
  EXPECT_THAT(report.notices[0], HasSubstr("part 'cage' is no manifold: 1 edges"));
  EXPECT_THAT(report.notices[0], HasSubstr("line 2"));
}

TEST(Subdivision, WhatIsNoCageIsRefusedWithItsLine) {
  EXPECT_THAT(refusal(support::cube_cage(), {SubdivisionScheme::kLoop, {}}), HasSubstr("1: part 'cage' is a control"));
  EXPECT_THAT(refusal(support::cube_cage(), {SubdivisionScheme::kLoop, {}}), HasSubstr("has 4 corners"));
  mesh::Model twice = support::cube_cage();
  twice.begin_polygon(mesh::MaterialId(0U), mesh::PartId(0U), 7);
  twice.add_loop(std::vector<std::uint32_t>{0, 1, 0, 2});
  EXPECT_THAT(refusal(twice), HasSubstr("7: part 'cage' is a control cage, and this polygon of it comes back"));
  EXPECT_THAT(refusal(support::square_with_hole()), HasSubstr("has a hole"));
  mesh::Model fan;
  for (int i = 0; i < 1100; ++i) {
    const double a = 0.005 * i;
    support::add_triangle(fan, {0, 0, 0}, {std::cos(a), std::sin(a), 0.1 * i},
                          {std::cos(a + 0.005), std::sin(a + 0.005), 0.1 * i + 0.1});
  }
  EXPECT_THAT(refusal(fan), HasSubstr("more than 1024 polygons meet"));
}

TEST(Subdivision, ACageThatHasNoLimitIsRefused) {
  mesh::Model square = support::facing_squares();
  for (std::size_t p = 0; p < square.part_names.size(); ++p)
    square.tags.rules.push_back({mesh::PartId(p), {mesh::SubdivisionRules::Boundary::kNone, false, false}});
  EXPECT_THAT(refusal(square), HasSubstr("leaves no surface at all"));
}

}  // namespace
}  // namespace clerestory
