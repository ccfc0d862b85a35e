// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/discontinuities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

/// A room with a lamp of 1 m × 0.5 m under the ceiling, a smaller and darker one beside it, and a shelf below them.
Study lamp_room() {
  mesh::Model model = support::box_room(6, 4, 3);
  support::add_quad(model, {1.5, 1.5, 2.9}, {1.5, 2.0, 2.9}, {2.5, 2.0, 2.9}, {2.5, 1.5, 2.9}, {"lamp", "lamp"});
  support::add_quad(model, {4.5, 1.5, 2.9}, {4.5, 1.6, 2.9}, {4.6, 1.6, 2.9}, {4.6, 1.5, 2.9}, {"spot", "spot"});
  support::add_quad(model, {2, 2, 2.2}, {3, 2, 2.2}, {3, 3, 2.2}, {2, 3, 2.2}, {"shelf", "shelf"});
  Study study = test::study_of(std::move(model), 0.5, {3, 2, 1});
  test::shine(test::material(study, "lamp"), 5000.0);
  test::shine(test::material(study, "spot"), 1000.0);
  study.sky.type = Sky::Type::kNone;
  return study;
}

SceneLines lines_at(const Scene& scene, double tolerance) {
  LineOptions options;
  options.tolerance = tolerance;
  return find_discontinuities(scene, options);
}

TEST(Discontinuities, SourcesComeStrongestFirst) {
  const Scene scene = build_scene(lamp_room());
  const ShadowSources sources = shadow_sources(scene, 64);
  ASSERT_EQ(sources.sources.size(), 2U);
  EXPECT_EQ(sources.names[0], "lamp");
  EXPECT_NEAR(sources.sources[0].power, 2500.0, 1e-6);
  EXPECT_NEAR(sources.sources[1].power, 10.0, 1e-6);
  EXPECT_LT(sources.sources[0].normal.z, -0.999);
  EXPECT_EQ(sources.sources[0].outline.at(0).size(), 4U);
  EXPECT_EQ(shadow_sources(scene, 1).left_out, 1U);
}

TEST(Discontinuities, FinerAccuracyKeepsMoreLines) {
  const Scene scene = build_scene(lamp_room());
  const SceneLines coarse = lines_at(scene, 0.1);
  const SceneLines fine = lines_at(scene, 0.0005);
  EXPECT_EQ(coarse.selection.found, fine.selection.found);
  EXPECT_LT(coarse.lines.size(), fine.lines.size());
  EXPECT_GT(coarse.lines.size(), 0U);
  // What the weak lamp does hardly matters where the strong one shines.
  EXPECT_TRUE(std::all_of(coarse.lines.begin(), coarse.lines.end(),
                          [](const mesh::DiscontinuityLine& line) { return line.source == 0; }));
}

TEST(Discontinuities, PointSourcesGiveShadowEdges) {
  Study study = lamp_room();
  for (Material& m : study.materials) m.front.emission.reset();
  study.point_sources.push_back({{3, 2, 2.5}, {0, 0, -1}, 100.0, false});
  const Scene scene = build_scene(study);
  const SceneLines found = lines_at(scene, 0.02);
  ASSERT_GT(found.lines.size(), 3U);
  for (const mesh::DiscontinuityLine& line : found.lines) EXPECT_EQ(line.order, 0);
  EXPECT_NEAR(found.sources.sources[0].power, 400.0 * std::numbers::pi, 1e-9);
}

TEST(Discontinuities, SmallElementsAndBrightPlacesNeedNoLines) {
  const Scene scene = build_scene(lamp_room());
  const auto kept = [&](double size_m, double lux) {
    LineOptions options;
    options.surroundings = [=](const mesh::DiscontinuityLine&, const mesh::Vector&) {
      return LineSurroundings{size_m, lux};
    };
    return find_discontinuities(scene, options).lines.size();
  };
  const std::size_t all = kept(1.0, 500.0);
  EXPECT_GT(all, 8U);
  EXPECT_LT(kept(0.01, 500.0), all);
  EXPECT_EQ(kept(1.0, 1e9), 0U);
  EXPECT_EQ(kept(1e-6, 500.0), 0U);
}

TEST(Discontinuities, ThinOccludersMatterLess) {
  // A bar of 2 cm hides little of a lamp of 1 m × 0.5 m at its height; where an interpolation may miss a fifth it needs no lines.
  Study study = lamp_room();
  study.model = support::box_room(6, 4, 3);
  support::add_quad(study.model, {1.5, 1.5, 2.9}, {1.5, 2.0, 2.9}, {2.5, 2.0, 2.9}, {2.5, 1.5, 2.9}, {"lamp", "lamp"});
  mesh::Model with_shelf = study.model;
  support::add_quad(study.model, {1.0, 2, 1.5}, {3, 2, 1.5}, {3, 2.02, 1.5}, {1.0, 2.02, 1.5}, {"shelf", "shelf"});
  support::add_quad(with_shelf, {1.0, 2, 1.5}, {3, 2, 1.5}, {3, 3, 1.5}, {1.0, 3, 1.5}, {"shelf", "shelf"});
  const auto kept = [&](mesh::Model model) {
    Study one = test::study_of(std::move(model), 0.5, {3, 2, 1});
    test::shine(test::material(one, "lamp"), 5000.0);
    return lines_at(build_scene(one), 0.2).lines.size();
  };
  EXPECT_EQ(kept(study.model), 0U);
  EXPECT_GT(kept(with_shelf), 0U);
}

TEST(Discontinuities, NothingThatShinesGivesNoLines) {
  Study study = lamp_room();
  for (Material& m : study.materials) m.front.emission.reset();
  const Scene scene = build_scene(study);
  EXPECT_TRUE(lines_at(scene, 0.02).lines.empty());
}

}  // namespace
}  // namespace clerestory::lighting
