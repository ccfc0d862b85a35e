// SPDX-License-Identifier: GPL-3.0-or-later
// A lamp over a black floor with something between: what surfaces.vtp gives by interpolation against the exact light, in umbra, penumbra and
// all round, and how many elements that takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "tests/support/blocked_lamp.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_samples.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

using mesh::Point;
using mesh::Vector;
using Polygon = std::vector<Point>;

constexpr mesh::Vector kUp{0, 0, 1};
constexpr double kWidth_m = 5.0;  ///< of the floor, about the origin, along x
constexpr double kDepth_m = 4.0;
constexpr double kAccuracy = 0.01;
constexpr double kApart_m = 0.05;

Polygon level_rectangle(double x0, double y0, double x1, double y1, double z) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

/// A polygon that shines down.
Polygon facing_down(Polygon polygon) {
  std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

/// Turned about z, with one end lifted, and moved.
Polygon tilted(Polygon polygon, double turn_rad, double lift, const Vector& by) {
  for (Point& p : polygon) {
    const double x = p.x * std::cos(turn_rad) - p.y * std::sin(turn_rad);
    const double y = p.x * std::sin(turn_rad) + p.y * std::cos(turn_rad);
    p = Point{x, y, p.z + lift * x} + by;
  }
  return polygon;
}

struct Case {
  std::string name;
  support::BlockedLamp scene;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

const Polygon kLamp = facing_down(level_rectangle(-0.6, -0.3, 0.6, 0.3, 3.0));
const Polygon kPlate = level_rectangle(-0.5, -0.4, 0.5, 0.4, 1.5);

/// Lines of order 1: edges of the blockers run along those of the lamp.
std::vector<Case> parallel_cases() {
  return {
      {"PlateInTheMiddle", {.lamp = kLamp, .blockers = {kPlate}}},
      {"TableUnderANarrowLamp",
       {.lamp = facing_down(level_rectangle(-0.6, -0.15, 0.6, 0.15, 2.7)),
        .blockers = {level_rectangle(0.0, -0.45, 1.4, 0.35, 0.75)}}},
      {"PlatesThatTouch",
       {.lamp = kLamp,
        .blockers = {level_rectangle(-0.5, -0.4, 0.1, 0.4, 1.5), level_rectangle(0.1, -0.4, 0.5, 0.4, 1.5)}}},
  };
}

/// Lines of order 2.
std::vector<Case> turned_cases() {
  return {
      {"PlateTurnedAndTilted", {.lamp = kLamp, .blockers = {tilted(kPlate, 0.4, 0.25, {0.3, 0.1, -0.2})}}},
      {"TurnedTable",
       {.lamp = facing_down(level_rectangle(-0.6, -0.15, 0.6, 0.15, 2.7)),
        .blockers = {tilted(level_rectangle(-0.6, -0.35, 0.6, 0.35, 0.75), 0.4, 0.0, {0.3, 0.1, 0})}}},
  };
}

lighting::Study study_of(const support::BlockedLamp& scene) {
  mesh::Model model;
  support::add_polygon(model, level_rectangle(-0.5 * kWidth_m, -0.5 * kDepth_m, 0.5 * kWidth_m, 0.5 * kDepth_m, 0.0),
                       {"floor", "floor"});
  support::add_polygon(model, scene.lamp, {"lamp", "lamp"});
  for (std::size_t i = 0; i < scene.blockers.size(); ++i)
    support::add_polygon(model, scene.blockers[i], {"blocker", "blocker " + std::to_string(i)});
  lighting::Study study = grey_study(std::move(model), 0.0);
  shine(material(study, "lamp"), scene.exitance_lm_m2);
  add_sensors(study, cell_centres({-0.5 * kWidth_m, -0.5 * kDepth_m, 0.1}, kWidth_m, kDepth_m, 6), kUp);
  study.accuracy.target = kAccuracy;
  return study;
}

/// Places along lines across the floor, level and slanted, through umbra and penumbra.
std::vector<Point> places() {
  constexpr int kPerLine = 400;
  const std::vector<std::array<Point, 2>> lines = {
      {Point{-2.4, 0.013, 0}, Point{2.4, 0.013, 0}}, {Point{0.021, -1.9, 0}, Point{0.021, 1.9, 0}},
      {Point{-2.4, 0.517, 0}, Point{2.4, 0.517, 0}}, {Point{0.483, -1.9, 0}, Point{0.483, 1.9, 0}},
      {Point{-2.1, -1.7, 0}, Point{1.9, 1.8, 0}},    {Point{-1.3, 1.8, 0}, Point{1.1, -1.9, 0}},
      {Point{-0.9, -1.9, 0}, Point{-0.6, 1.9, 0}},   {Point{1.17, -1.9, 0}, Point{1.36, 1.9, 0}},
      {Point{-2.4, -0.73, 0}, Point{2.4, -0.61, 0}}, {Point{-2.4, 0.91, 0}, Point{2.4, 1.23, 0}},
  };
  std::vector<Point> found;
  for (const auto& [from, to] : lines) {
    for (int i = 0; i <= kPerLine; ++i) found.push_back(from + (1.0 * i / kPerLine) * (to - from));
  }
  return found;
}

/// Exact light at the places, and the most of it.
struct Exact {
  explicit Exact(const support::BlockedLamp& scene) {
    for (const Point& p : places()) lux.push_back(exact_illuminance(scene, p, kUp));
    peak = *std::max_element(lux.begin(), lux.end());
  }
  std::vector<double> lux;
  double peak = 0.0;
};

/// Whether a uniform mesh errs by no more than so much at any place: squares cut into two triangles each, with exact light at the corners.
bool suffices(const support::BlockedLamp& scene, const Exact& exact, double side, double most_lux) {
  const auto light = [&](double i, double j) {
    return exact_illuminance(scene, {-0.5 * kWidth_m + i * side, -0.5 * kDepth_m + j * side, 0}, kUp);
  };
  const std::vector<Point> at = places();
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double x = (at[k].x + 0.5 * kWidth_m) / side;
    const double y = (at[k].y + 0.5 * kDepth_m) / side;
    const double i = std::floor(x);
    const double j = std::floor(y);
    const double u = x - i;
    const double v = y - j;
    const double low = light(i, j);
    const double high = light(i + 1, j + 1);
    const double corner = u > v ? light(i + 1, j) : light(i, j + 1);
    const double value = low + std::min(u, v) * (high - corner) + std::max(u, v) * (corner - low);
    if (std::abs(value - exact.lux[k]) > most_lux) return false;
  }
  return true;
}

/// The number of triangles of the first uniform mesh, from coarse to fine, that errs by no more than a share of the peak.
double uniform_count(const support::BlockedLamp& scene, const Exact& exact, double share) {
  double side = 0.2;
  while (!suffices(scene, exact, side, share * exact.peak) && side > 2e-3) side /= 1.2;
  return 2.0 * kWidth_m * kDepth_m / (side * side);
}

/// What surfaces.vtp gives at the places.
struct Shown {
  double worst = 0.0;  ///< error, as a share of the peak
  Point where;
  std::size_t cells = 0;
};

/// @param apart  places near these are left out
Shown shown(const support::BlockedLamp& scene, const Exact& exact, const std::vector<Point>& apart = {}) {
  const lighting::Results results = answer(study_of(scene));
  const support::SurfaceSamples floor(results.surfaces, "floor");
  Shown result;
  result.cells = floor.cells().size();
  const std::vector<Point> at = places();
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto is_near = [&](const Point& p) { return norm(at[i] - p) < kApart_m; };
    if (std::any_of(apart.begin(), apart.end(), is_near)) continue;
    const auto value = floor.at(at[i].x, at[i].y);
    EXPECT_TRUE(value) << at[i].x << " " << at[i].y;
    const double error = std::abs(value.value_or(0.0) - exact.lux[i]) / exact.peak;
    if (error > result.worst) result.where = at[i];
    result.worst = std::max(result.worst, error);
  }
  return result;
}

class AlongLampEdges : public testing::TestWithParam<Case> {};

TEST_P(AlongLampEdges, InterpolationMeetsTheExactLightWithATenthOfTheElements) {
  const support::BlockedLamp& scene = GetParam().scene;
  const Exact exact(scene);
  const Shown result = shown(scene, exact);
  EXPECT_LT(result.worst, kAccuracy) << "at " << result.where.x << " " << result.where.y;
  EXPECT_LT(10.0 * static_cast<double>(result.cells), uniform_count(scene, exact, kAccuracy));
}

INSTANTIATE_TEST_SUITE_P(ShadowLine, AlongLampEdges, testing::ValuesIn(parallel_cases()),
                         [](const auto& tested) { return tested.param.name; });

class AcrossLampEdges : public testing::TestWithParam<Case> {};

// Here light has no kinks, and elements of one size do well where it is curved: what is left is that they are small everywhere.
TEST_P(AcrossLampEdges, InterpolationMeetsTheExactLightWithFewerElements) {
  const support::BlockedLamp& scene = GetParam().scene;
  const Exact exact(scene);
  const Shown result = shown(scene, exact);
  EXPECT_LT(result.worst, kAccuracy) << "at " << result.where.x << " " << result.where.y;
  EXPECT_LT(static_cast<double>(result.cells), uniform_count(scene, exact, kAccuracy));
}

INSTANTIATE_TEST_SUITE_P(ShadowLine, AcrossLampEdges, testing::ValuesIn(turned_cases()),
                         [](const auto& tested) { return tested.param.name; });

TEST(ShadowLine, ScreenOnTheFloorIsRightUpToItsFoot) {
  const support::BlockedLamp scene{.lamp = kLamp,
                                   .blockers = {{{-0.7, 0.6, 0}, {0.9, 0.9, 0}, {0.9, 0.9, 1}, {-0.7, 0.6, 1}}}};
  const Exact exact(scene);
  // From the ends of its foot the lines of the penumbra spread like a fan, and those nearer to each other than 1 cm are one.
  const Shown result = shown(scene, exact, {scene.blockers[0][0], scene.blockers[0][1]});
  EXPECT_LT(result.worst, kAccuracy) << "at " << result.where.x << " " << result.where.y;
}

TEST(ShadowLine, LouvreOfFortySlatsStaysInItsBudgetAndIsRight) {
  support::BlockedLamp louvre{.lamp = kLamp, .blockers = {}};
  for (int i = 0; i < 40; ++i)
    louvre.blockers.push_back(level_rectangle(-0.8 + 0.04 * i, -0.5, -0.78 + 0.04 * i, 0.5, 1.5));
  const Shown result = shown(louvre, Exact(louvre));
  EXPECT_LT(result.worst, kAccuracy) << "at " << result.where.x << " " << result.where.y;
  EXPECT_LT(result.cells, 9000U);
}

}  // namespace
}  // namespace clerestory::test
