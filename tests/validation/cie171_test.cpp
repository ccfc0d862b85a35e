// SPDX-License-Identifier: GPL-3.0-or-later
// CIE 171:2006, Test cases to assess the accuracy of lighting computer programs: 5.3, 5.6, 5.7 and 5.9–5.12. The values were
// recomputed from the formulas; several printed cells of the report are wrong. Tolerance: 1 % of each value, or 0.01 lx
// (5.3–5.7) or 0.01 % of the horizontal illuminance (5.9–5.12) where that is larger. The rooms are black and the light is direct, so that
// the default accuracy must do, except where light has to be found by sampling: behind the box of 5.7, and through holes that nothing
// marks. An accuracy is a standard uncertainty: every one of some 150 sensors keeps 1 % if that is over three of it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/places.h"
#include "tests/validation/cie171_rooms.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

using cie171::row_points;
using cie171::wall_points;

constexpr double kRelativeTolerance = 0.01;
constexpr double kAccuracyOfSampled = 0.0025;
constexpr mesh::Vector kUp{0, 0, 1};
constexpr mesh::Vector kDown{0, 0, -1};
constexpr mesh::Vector kNorth{0, 1, 0};
constexpr mesh::Vector kSouth{0, -1, 0};

/// Expects the only grid to hold these values [lx].
void expect_values(const std::string& what, const lighting::Results& results, const std::vector<double>& expected,
                   double absolute_tolerance_lux) {
  const std::vector<float>& values = results.grids.at(0).illuminance_lux;
  ASSERT_EQ(values.size(), expected.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double tolerance = std::max(kRelativeTolerance * expected[i], absolute_tolerance_lux);
    EXPECT_NEAR(values[i], expected[i], tolerance) << what << ", sensor " << i;
    worst = std::max(worst, std::abs(values[i] - expected[i]) / tolerance);
  }
  std::printf("[ FIGURES  ] %s: largest difference %.3f of the tolerance\n", what.c_str(), worst);
}

TEST(Cie171, Case53AreaSourceInTheCeiling) {
  lighting::Study study = grey_study(cie171::room({{"ceiling", "lamp", 1.5, 1.5, 2.5, 2.5}}), 0.0);
  shine(material(study, "lamp"), 1000.0 * std::numbers::pi);
  add_sensors(study, wall_points(0.0), kNorth);
  add_sensors(study, row_points(0.0), kUp);
  expect_values("5.3", answer(study),
                {32.677, 75.194, 81.323, 69.061, 53.404, 40.002,  //
                 61.424, 79.255, 95.667, 105.778, 105.778, 95.667, 79.255, 61.424},
                0.01);
}

TEST(Cie171, Case56WholeFloorAsReflector) {
  lighting::Study study = grey_study(cie171::room(), 0.0);
  shine(material(study, "floor"), 100.0);  // values are per cent of what the reflector sends out
  auto wall = wall_points(0.0);
  wall.pop_back();  // z = 0.25 is not given
  add_sensors(study, wall, kNorth);
  add_sensors(study, row_points(3.0), kDown);
  expect_values("5.6, 4 m x 4 m", answer(study),
                {12.9674, 16.7163, 21.6385, 27.9916, 35.9005,  //
                 26.795, 30.939, 33.976, 35.567, 35.567, 33.976, 30.939, 26.795},
                0.01);
}

TEST(Cie171, Case56SmallReflectorInTheFloor) {
  lighting::Study study = grey_study(cie171::room({{"floor", "reflector", 1.75, 1.75, 2.25, 2.25}}), 0.0);
  shine(material(study, "reflector"), 10'000.0);  // values x 100 are per cent of what the reflector sends out
  auto wall = wall_points(0.0);
  std::reverse(wall.begin(), wall.end());  // A is the lowest point here
  auto row = row_points(3.0);
  row.resize(4);
  add_sensors(study, wall, kNorth);
  add_sensors(study, row, kDown);
  expect_values("5.6, 0.5 m x 0.5 m", answer(study),
                {24.58, 57.99, 64.44, 55.64, 43.33, 32.51, 49.14, 63.91, 77.76, 86.43}, 0.01);
}

TEST(Cie171, Case57WallAsReflectorBehindAnObstruction) {
  mesh::Model model = cie171::room();
  support::add_box(model, {0, 2.5, 0}, {4, 2.7, 1}, {.material = "box", .part = "box"});
  lighting::Study study = grey_study(std::move(model), 0.0);
  shine(material(study, "north"), 100.0);
  study.accuracy.target = kAccuracyOfSampled;
  auto row = row_points(0.0);
  row.resize(5);
  add_sensors(study, wall_points(0.0), kNorth);
  add_sensors(study, row, kUp);
  const lighting::Results results = answer(study);
  expect_values("5.7", results, {16.0706, 16.3297, 15.3988, 13.3220, 10.3169, 7.0790, 3.3823, 3.6290, 3.0130, 0.0, 0.0},
                0.01);
  // K sees nothing of the reflector; J lies on the very edge of its shadow.
  EXPECT_EQ(results.grids.at(0).illuminance_lux.at(10), 0.0F);
}

/// The published values of one case, in per cent of the horizontal illuminance, by the names of the points.
std::vector<double> sky_values(const std::string& name, int sky, const std::vector<std::string>& points) {
  std::ifstream in(validation_dir() / "cie171_sky.json");
  const auto all = nlohmann::json::parse(in);
  std::vector<double> values;
  for (const std::string& point : points)
    values.push_back(all.at(name + " sky" + std::to_string(sky)).at(point).get<double>());
  return values;
}

/// What fills an opening.
struct Filling {
  const char* what;
  const char* material;  ///< empty: an unmarked hole
};
constexpr Filling kUnmarked{"unmarked", ""};
constexpr Filling kMarked{"marked", "air"};
constexpr Filling kGlazed{"glazed", "pane"};

constexpr int kTraditional = 16;  ///< the CIE's number of the traditional overcast sky
constexpr std::array kOtherSkies{1, 5, 12};

/// 100 lx horizontal, so that values are per cent. The sun stands at 60°, on the side of +y or -y.
lighting::Sky sky_of_case(int type, double sun_side) {
  if (type == kTraditional)
    return {.type = lighting::Sky::Type::kCieOvercast, .horizontal_illuminance_lux = 100.0, .ground_reflectance = 0.3};
  lighting::Sky sky = lighting::sky_of(lighting::cie_general_sky(type, {0.0, sun_side * 0.5, std::sqrt(0.75)}), 100.0);
  sky.ground_reflectance = 0.3;
  return sky;
}

/// A black room.
/// @param outside  what stands before the opening
lighting::Study daylit_room(cie171::Cutout opening, const Filling& filling, const lighting::Sky& sky,
                            const mesh::Model& outside = {}) {
  opening.material = filling.material;
  mesh::Model model = cie171::room({opening});
  support::append(model, outside);
  lighting::Study study = grey_study(std::move(model), 0.0);
  study.kind = lighting::Study::Kind::kDaylight;
  if (opening.material.empty()) study.accuracy.target = kAccuracyOfSampled;
  study.sky = sky;
  for (lighting::Material& m : study.materials) {
    if (m.name == "air")
      m = {.name = "air", .front = {}, .back = {}, .glazing = {}, .opening = true, .became = {}, .why = {}};
    if (m.name == "pane") {
      m.front.reflectance = m.back.reflectance = std::nullopt;
      m.glazing = lighting::Glazing{.transmittance_normal = 0.88, .panes = 1};
    }
  }
  return study;
}

void expect_roof_case(const std::string& name, const cie171::Cutout& opening, const Filling& filling,
                      int sky = kTraditional) {
  lighting::Study study = daylit_room(opening, filling, sky_of_case(sky, 1.0));
  add_sensors(study, wall_points(0.0), kNorth);
  add_sensors(study, row_points(0.0), kUp);
  const auto expected = sky_values(name, sky, {"A", "B", "C", "D", "E", "F", "G", "H", "I", "J", "K", "L", "M", "N"});
  expect_values(name + " sky" + std::to_string(sky) + ", " + filling.what, answer(study), expected, 0.01);
}

void expect_facade_case(const std::string& name, const cie171::Cutout& opening, const Filling& filling,
                        int sky = kTraditional) {
  lighting::Study study = daylit_room(opening, filling, sky_of_case(sky, -1.0));
  auto floor = row_points(0.0);
  auto ceiling = row_points(3.0);
  std::reverse(floor.begin(), floor.end());  // G is the farthest from the opening
  std::reverse(ceiling.begin(), ceiling.end());
  add_sensors(study, wall_points(4.0), kSouth);
  add_sensors(study, floor, kUp);
  add_sensors(study, ceiling, kDown);
  const auto expected = sky_values(name, sky, {"A", "B", "C", "D",  "E",  "F",  "G",  "H",  "I",  "J",  "K",
                                               "L", "M", "N", "G'", "H'", "I'", "J'", "K'", "L'", "M'", "N'"});
  expect_values(name + " sky" + std::to_string(sky) + ", " + filling.what, answer(study), expected, 0.01);
}

const cie171::Cutout kSmallRoof{"ceiling", "", 1.5, 1.5, 2.5, 2.5};
const cie171::Cutout kWholeRoof{"ceiling", "", 0, 0, 4, 4};
const cie171::Cutout kWindow{"south", "", 1, 1, 3, 2};
const cie171::Cutout kWholeWall{"south", "", 0, 0, 4, 3};

TEST(Cie171, Case59RoofOpening) {
  CLERESTORY_NEEDS_VALIDATION("cie171_sky.json");
  for (const Filling& filling : {kMarked, kUnmarked}) {
    expect_roof_case("5.9 1x1", kSmallRoof, filling);
    expect_roof_case("5.9 4x4", kWholeRoof, filling);
  }
}

TEST(Cie171, Case510GlazedRoofOpening) {
  CLERESTORY_NEEDS_VALIDATION("cie171_sky.json");
  expect_roof_case("5.10 1x1", kSmallRoof, kGlazed);
  expect_roof_case("5.10 4x4", kWholeRoof, kGlazed);
}

TEST(Cie171, Case511FacadeOpening) {
  CLERESTORY_NEEDS_VALIDATION("cie171_sky.json");
  for (const Filling& filling : {kMarked, kUnmarked}) {
    expect_facade_case("5.11 2x1", kWindow, filling);
    expect_facade_case("5.11 4x3", kWholeWall, filling);
  }
}

TEST(Cie171, Case512GlazedFacadeOpening) {
  CLERESTORY_NEEDS_VALIDATION("cie171_sky.json");
  expect_facade_case("5.12 2x1", kWindow, kGlazed);
  expect_facade_case("5.12 4x3", kWholeWall, kGlazed);
}

TEST(Cie171, Cases59To512UnderTheOtherSkies) {
  CLERESTORY_NEEDS_VALIDATION("cie171_sky.json");
  for (const int sky : kOtherSkies) {
    expect_roof_case("5.9 1x1", kSmallRoof, kMarked, sky);
    expect_roof_case("5.9 4x4", kWholeRoof, kMarked, sky);
    expect_roof_case("5.10 1x1", kSmallRoof, kGlazed, sky);
    expect_roof_case("5.10 4x4", kWholeRoof, kGlazed, sky);
    expect_facade_case("5.11 2x1", kWindow, kMarked, sky);
    expect_facade_case("5.11 4x3", kWholeWall, kMarked, sky);
    expect_facade_case("5.12 2x1", kWindow, kGlazed, sky);
    expect_facade_case("5.12 4x3", kWholeWall, kGlazed, sky);
  }
}

/// A black mask at the height of the ceiling that reaches so far out, and 100 m to either side.
mesh::Model mask(double depth_m) {
  mesh::Model model;
  support::add_quad(model, {-98, -depth_m, 3}, {102, -depth_m, 3}, {102, 0, 3}, {-98, 0, 3},
                    {.material = "mask", .part = "mask"});
  return model;
}

TEST(Cie171, Case513MaskBeforeAFacadeOpening) {
  CLERESTORY_NEEDS_VALIDATION("cie171_sky.json");
  const std::vector<std::string> points{"A_sky", "B_sky", "C_sky", "D_sky", "E_sky", "F_sky", "G_sky", "H_sky"};
  for (const int sky : {1, 5, 12, kTraditional}) {
    for (const auto& [name, depth] : {std::pair{"5.13 0.5", 0.5}, {"5.13 1.0", 1.0}, {"5.13 2.0", 2.0}}) {
      lighting::Study study = daylit_room(kWindow, kMarked, sky_of_case(sky, -1.0), mask(depth));
      study.accuracy.target = kAccuracyOfSampled;
      auto floor = row_points(0.0);
      std::reverse(floor.begin(), floor.end());
      add_sensors(study, floor, kUp);
      expect_values(std::string(name) + " sky" + std::to_string(sky), answer(study), sky_values(name, sky, points),
                    0.01);
    }
  }
}

}  // namespace
}  // namespace clerestory::test
