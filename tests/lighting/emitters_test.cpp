// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/emitters.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lighting/form_factor.h"
#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

const Vector kUp{0, 0, 1};
constexpr double kTwo = 2.0;  ///< height of the lamps [m]

/// A floor of 6 m × 6 m under lamps that shine down, none of which anything hides but a plate of 2 m × 2 m.
struct LampsOverFloor : test::Stage {
  static Study study(const std::vector<std::vector<Point>>& outlines) {
    mesh::Model model;
    support::add_quad(model, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, {"floor", "floor"});
    support::add_quad(model, {1, -1, 1}, {3, -1, 1}, {3, 1, 1}, {1, 1, 1}, {"plate", "plate"});
    for (const auto& lamp : outlines) support::add_polygon(model, lamp, {"lamp", "lamp"});
    Study study = test::study_of(std::move(model), 0.0, {0, 0, 0.5});
    test::shine(test::material(study, "lamp"), 1000.0);
    return study;
  }
  explicit LampsOverFloor(const std::vector<std::vector<Point>>& outlines)
      : Stage(study(outlines)), lamps(emitters(solution)) {}

  [[nodiscard]] double full(const Emitter& lamp, const Point& from) const {
    return full_factor(solution, lamp, local(from), kUp);
  }
  [[nodiscard]] SeenFactor seen(const Emitter& lamp, const Point& from) const {
    return seen_factor(solution, lamp, full(lamp, from), local(from), kUp);
  }

  std::vector<Emitter> lamps;
};

std::vector<Point> rectangle(double x, double y, double width, double depth) {
  return {{x, y, kTwo}, {x, y + depth, kTwo}, {x + width, y + depth, kTwo}, {x + width, y, kTwo}};
}

/// An L of three squares, whose middle corner is not convex.
std::vector<Point> angle() {
  return {{-1, -1, kTwo}, {-1, 1, kTwo}, {0, 1, kTwo}, {0, 0, kTwo}, {1, 0, kTwo}, {1, -1, kTwo}};
}

TEST(Emitters, ConvexOutlinesOfFourCornersAreOnePiece) {
  const LampsOverFloor site({rectangle(-1, -1, 2, 1)});
  ASSERT_EQ(site.lamps.size(), 1U);
  ASSERT_EQ(site.lamps[0].pieces.size(), 1U);
  EXPECT_EQ(site.lamps[0].pieces[0].count, 4U);
}

TEST(Emitters, CornersOnStraightEdgesAreNone) {
  const LampsOverFloor site(
      {{{-1, -1, kTwo}, {-1, 0, kTwo}, {1, 0, kTwo}, {1, -0.5, kTwo}, {1, -1, kTwo}, {0.2, -1, kTwo}}});
  ASSERT_EQ(site.lamps.size(), 1U);
  ASSERT_EQ(site.lamps[0].pieces.size(), 1U);
  EXPECT_EQ(site.lamps[0].pieces[0].count, 4U);
  EXPECT_NEAR(site.seen(site.lamps[0], {0, 0, 0}).factor, site.full(site.lamps[0], {0, 0, 0}), 1e-12);
}

TEST(Emitters, OtherOutlinesAreTheirTriangles) {
  const LampsOverFloor site({angle()});
  ASSERT_EQ(site.lamps.size(), 1U);
  double area = 0.0;
  for (const mesh::ShaftEnd& piece : site.lamps[0].pieces) {
    ASSERT_EQ(piece.count, 3U);
    const auto& c = piece.corners;
    area += 0.5 * dot(cross(c[1] - c[0], c[2] - c[0]), piece.normal);
  }
  EXPECT_NEAR(area, 3.0, 1e-9);
}

TEST(Emitters, PiecesGiveTogetherWhatTheWholeGives) {
  const LampsOverFloor whole({angle()});
  const LampsOverFloor parts({rectangle(-1, -1, 2, 1), rectangle(-1, 0, 1, 1)});
  for (const Point& from : {Point{-2, 0, 0}, Point{1.5, 0.2, 0}, Point{2, -2.5, 0}}) {
    double sum = 0.0;
    for (const Emitter& lamp : parts.lamps) {
      const SeenFactor seen = parts.seen(lamp, from);
      EXPECT_TRUE(seen.exact);
      sum += seen.factor;
    }
    const SeenFactor seen = whole.seen(whole.lamps[0], from);
    EXPECT_TRUE(seen.exact);
    EXPECT_NEAR(seen.factor, sum, 1e-9) << from.x;
  }
}

TEST(Emitters, FacetsOfAFileWithSixDecimalsDoNotHideThemselves) {
  // Their corners lie off their planes by some tenths of a micrometre.
  mesh::Model model;
  support::add_globe(model, {1.5, 1.5, 2.3}, 0.15, 32, 16, {"lamp", "globe"});
  for (Point& p : model.vertices)
    p = {std::round(p.x * 1e6) / 1e6, std::round(p.y * 1e6) / 1e6, std::round(p.z * 1e6) / 1e6};
  Study study = test::study_of(std::move(model), 0.0, {0, 0, 0.5});
  test::shine(test::material(study, "lamp"), 1000.0);
  const test::Stage stage(study);
  for (const Point& from : {Point{0.625, 0.625, 0.8}, Point{3.875, 0.625, 0.8}}) {
    double full = 0.0;
    double seen = 0.0;
    for (const Emitter& facet : emitters(stage.solution)) {
      const double factor = full_factor(stage.solution, facet, stage.local(from), kUp);
      full += factor;
      seen += seen_factor(stage.solution, facet, factor, stage.local(from), kUp).factor;
    }
    EXPECT_GT(full, 0.0);
    EXPECT_NEAR(seen, full, 1e-4 * full) << from.x;
  }
}

TEST(Emitters, InSightAreThoseThatAreNotProvenHidden) {
  // From under the plate's middle the first is hidden, the second partly, the third wholly seen.
  const LampsOverFloor site(
      {rectangle(1.8, -0.2, 0.4, 0.4), rectangle(0.0, -0.2, 1.4, 0.4), rectangle(-2.8, -0.2, 0.4, 0.4)});
  ASSERT_EQ(site.lamps.size(), 3U);
  mesh::ShaftEnd from{.corners = {}, .count = 4, .normal = kUp};
  const Point corner = site.local({1.9, -0.1, 0});
  from.corners = {corner, corner + Vector{0.2, 0, 0}, corner + Vector{0.2, 0.2, 0}, corner + Vector{0, 0.2, 0}};
  constexpr std::array<std::uint32_t, 3> kAll{0, 1, 2};
  const std::vector<EmitterInSight> found = in_sight(site.solution, site.lamps, kAll, from);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].emitter, &site.lamps[1]);
  EXPECT_FALSE(found[0].wholly);
  EXPECT_EQ(found[1].emitter, &site.lamps[2]);
  EXPECT_TRUE(found[1].wholly);
  EXPECT_EQ(in_sight(site.solution, site.lamps, std::span(kAll).first(2), from).size(), 1U) << "of those asked for";
}

}  // namespace
}  // namespace clerestory::lighting
