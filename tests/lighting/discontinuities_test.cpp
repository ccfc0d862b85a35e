// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/discontinuities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/lighting/stages.h"
#include "tests/support/blocked_lamp.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

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
  study.luminaires.push_back(clerestory::test::isotropic_lamp({3, 2, 2.5}, 100.0));
  const Scene scene = build_scene(study);
  const SceneLines found = lines_at(scene, 0.02);
  ASSERT_GT(found.lines.size(), 3U);
  for (const mesh::DiscontinuityLine& line : found.lines) EXPECT_EQ(line.order, 0);
  EXPECT_NEAR(found.sources.sources[0].power, 400.0 * std::numbers::pi, 1e-9);
}

TEST(Discontinuities, PanelsHavePenumbras) {
  Study study = lamp_room();
  for (Material& m : study.materials) m.front.emission.reset();
  Luminaire panel = clerestory::test::lambertian_lamp({2.5, 2, 2.6}, {0, 0, -1}, 1000.0);
  panel.opening = {.shape = LuminousOpening::Shape::kRectangle, .x_m = 1.2, .y_m = 0.3};
  study.luminaires.push_back(panel);
  const Scene scene = build_scene(study);
  const SceneLines found = lines_at(scene, 0.02);
  EXPECT_GT(found.lines.size(), 3U);
  for (const mesh::DiscontinuityLine& line : found.lines) EXPECT_GT(line.order, 0);
  EXPECT_NEAR(found.sources.exitance_lm_m2[0], std::numbers::pi * 1000.0 / 0.36, 1.0);
  LineOptions jumps;
  jumps.jumps_only = true;
  EXPECT_TRUE(find_discontinuities(scene, jumps).lines.empty());
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

/// A lamp over a black floor and what stands between, as a study.
Study study_of(const support::BlockedLamp& lamp) {
  mesh::Model model;
  support::add_quad(model, {-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, {"floor", "floor"});
  support::add_polygon(model, lamp.lamp, {"lamp", "lamp"});
  for (const auto& blocker : lamp.blockers) support::add_polygon(model, blocker, {"blocker", "blocker"});
  Study study = test::study_of(std::move(model), 0.0, {3, 3, 0.1});
  test::shine(test::material(study, "lamp"), lamp.exitance_lm_m2);
  return study;
}

/// The jump of the derivative of order 1 or 2 across a line in its middle, by differences of exact light on both sides [lux/m^k].
double exact_jump(const support::BlockedLamp& lamp, const Point& middle, const Vector& across, int order, double step) {
  const auto side = [&](double sign) {
    std::array<double, 4> e{};
    for (std::size_t i = 0; i < 4; ++i)
      e[i] = exact_illuminance(lamp, middle + sign * static_cast<double>(i) * step * across, {0, 0, 1});
    return order == 1 ? sign * (-1.5 * e[0] + 2.0 * e[1] - 0.5 * e[2]) / step
                      : (2.0 * e[0] - 5.0 * e[1] + 4.0 * e[2] - e[3]) / (step * step);
  };
  return std::abs(side(1.0) - side(-1.0));
}

/// A level rectangle of half sides a and b about the z axis, turned about it, and tilted about y.
std::vector<Point> rectangle(double a, double b, double height, double turn_rad = 0.0, double slope = 0.0) {
  std::vector<Point> corners;
  for (const auto& [u, v] : {std::pair(-a, -b), std::pair(-a, b), std::pair(a, b), std::pair(a, -b)}) {
    const double x = u * std::cos(turn_rad) - v * std::sin(turn_rad);
    corners.push_back({x, u * std::sin(turn_rad) + v * std::cos(turn_rad), height + slope * x});
  }
  return corners;
}

/// Compares the estimate with exact light on all lines of a floor; returns how many there are.
std::size_t compare_jumps(const support::BlockedLamp& lamp) {
  constexpr double kStep_m = 1e-3;
  const Scene scene = build_scene(study_of(lamp));
  const SceneLines found = lines_at(scene, 1e-9);
  std::size_t count = 0;
  for (const mesh::DiscontinuityLine& line : found.lines) {
    const mesh::Face& face = scene.faces.faces[line.face.index()];
    if (scene.faces.material_names[face.material.index()] != "floor") continue;
    ++count;
    const Point middle = midpoint(line.ends[0], line.ends[1]) + scene.faces.origin;
    const Vector across = cross(Vector{0, 0, 1}, normalized(line.ends[1] - line.ends[0]));
    const double exact = exact_jump(lamp, middle, across, line.order, kStep_m);
    const double ratio = estimated_jump(scene, found.sources, line) / exact;
    EXPECT_GT(ratio, 0.85) << "order " << int{line.order} << " at " << middle.x << " " << middle.y;
    EXPECT_LT(ratio, 1.15) << "order " << int{line.order} << " at " << middle.x << " " << middle.y;
  }
  return count;
}

TEST(Discontinuities, EstimatedJumpsOfSlopesAreThoseOfExactLight) {
  for (const auto& [a, b] : {std::pair(0.6, 0.3), std::pair(0.75, 0.03)})  // a strip as well
    EXPECT_GT(compare_jumps({rectangle(a, b, 3.0), 1000.0, {rectangle(0.5, 0.4, 1.5)}}), 12U);
  EXPECT_GT(compare_jumps({rectangle(0.6, 0.15, 2.7), 1000.0, {rectangle(0.7, 0.4, 0.75)}}), 12U);
}

TEST(Discontinuities, EstimatedJumpsOfCurvatureAreThoseOfExactLight) {
  for (const double turn_rad : {0.05, 0.4, 0.7})  // almost along the lamp as well
    EXPECT_EQ(compare_jumps({rectangle(0.6, 0.3, 3.0), 1000.0, {rectangle(0.5, 0.4, 1.5, turn_rad)}}), 32U);
  EXPECT_EQ(compare_jumps({rectangle(0.75, 0.03, 3.0), 1000.0, {rectangle(0.5, 0.4, 1.5, 0.4, 0.2)}}), 32U);
}

TEST(Discontinuities, EstimatedJumpsOfLightAreThoseOfExactLight) {
  Study study = study_of({rectangle(0.6, 0.3, 3.0), 0.0, {rectangle(0.5, 0.4, 1.5)}});
  for (Material& m : study.materials) m.front.emission.reset();
  study.luminaires.push_back(clerestory::test::isotropic_lamp({0.1, 0.2, 2.8}, 100.0));
  const Scene scene = build_scene(study);
  const SceneLines found = lines_at(scene, 1e-9);
  EXPECT_GT(found.lines.size(), 3U);
  for (const mesh::DiscontinuityLine& line : found.lines) {
    const Vector to = study.luminaires[0].at - (midpoint(line.ends[0], line.ends[1]) + scene.faces.origin);
    const double lux = 100.0 * to.z / std::pow(norm(to), 3);
    if (lux <= 0.0) continue;  // on the back of the lamp
    EXPECT_NEAR(estimated_jump(scene, found.sources, line), lux, 1e-6 * lux);
  }
}

TEST(Discontinuities, NothingThatShinesGivesNoLines) {
  Study study = lamp_room();
  for (Material& m : study.materials) m.front.emission.reset();
  const Scene scene = build_scene(study);
  EXPECT_TRUE(lines_at(scene, 0.02).lines.empty());
}

/// A run whose time is over.
struct Late final : Progress {
  void phase(std::string_view) override {}
  void advance(double) override { ++told; }
  [[nodiscard]] bool should_finish(double) const override { return true; }
  int told = 0;
};

TEST(Discontinuities, NoSourceIsTracedOnceTheTimeIsOver) {
  Late late;
  LineOptions options;
  options.progress = &late;
  EXPECT_TRUE(find_discontinuities(build_scene(lamp_room()), options).lines.empty());
  EXPECT_GT(late.told, 0);
}

}  // namespace
}  // namespace clerestory::lighting
