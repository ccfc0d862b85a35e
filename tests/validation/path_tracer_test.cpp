// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle must be right before anything is measured by it: closed forms, and the references of other programs.
#include "tests/support/path_tracer.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/lamps.h"
#include "tests/support/places.h"
#include "tests/support/shapes.h"
#include "tests/support/traced_scene.h"
#include "tests/support/validation_scenes.h"
#include "tests/validation/statistics.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

using mesh::Point;
using mesh::Vector;

/// A square of 200 m at a height, front up.
mesh::Model large_square(double height_m) {
  mesh::Model model;
  support::add_quad(model, {-100, -100, height_m}, {100, -100, height_m}, {100, 100, height_m}, {-100, 100, height_m});
  return model;
}

Traced trace_one(const lighting::Study& study, const Point& at, const Vector& normal, const TraceOptions& options) {
  return trace_illuminance(traced_scene(study), std::vector{at}, std::vector{normal}, options).front();
}

void expect_within_noise(const Traced& traced, double exact) {
  EXPECT_NEAR(traced.illuminance_lux, exact, 4.0 * traced.standard_error_lux);
}

TEST(PaneOptics, TransmittanceFollowsThePublishedCurve) {
  const double degree = std::numbers::pi / 180.0;
  const std::vector<std::pair<double, double>> at_070 = {{0, .7000},  {30, .6870}, {50, .6495}, {60, .6027},
                                                         {70, .5040}, {80, .2951}, {85, .1349}};
  for (const auto& [angle, transmittance] : at_070)
    EXPECT_NEAR(pane_optics(0.70, std::cos(angle * degree)).transmittance, transmittance, 6e-5) << angle;
  const std::vector<std::pair<double, double>> at_088 = {{0, .8800},  {15, .8793}, {30, .8755}, {45, .8599},
                                                         {60, .7999}, {70, .6839}, {75, .5774}, {80, .4235}};
  for (const auto& [angle, transmittance] : at_088)
    EXPECT_NEAR(pane_optics(0.88, std::cos(angle * degree)).transmittance, transmittance, 6e-5) << angle;
}

TEST(PaneOptics, HemisphericalValuesFollowThePublishedOnes) {
  double transmittance = 0.0;
  double reflectance = 0.0;
  const int steps = 2000;
  for (int i = 0; i < steps; ++i) {  // mean over cos²: the cosine-weighted hemisphere
    const PaneOptics pane = pane_optics(0.70, std::sqrt((i + 0.5) / steps));
    transmittance += pane.transmittance / steps;
    reflectance += pane.reflectance / steps;
    ASSERT_LE(pane.transmittance + pane.reflectance, 1.0);
  }
  EXPECT_NEAR(transmittance / 0.70, 0.885, 5e-4);
  EXPECT_NEAR(reflectance, 0.125, 5e-4);
  EXPECT_NEAR(pane_optics(0.70, 1.0).reflectance, 0.065, 5e-4);
}

TEST(PathTracer, OpenPlaneReceivesTheHorizontalIlluminanceOfTheSky) {
  for (const auto type : {lighting::Sky::Type::kUniform, lighting::Sky::Type::kCieOvercast}) {
    lighting::Study study = grey_study(large_square(0.0), 0.2);
    study.sky.type = type;
    expect_within_noise(trace_one(study, {0, 0, 0.5}, {0, 0, 1}, {.paths = 20'000}), 10'000.0);
  }
}

TEST(PathTracer, OpenPlaneReceivesClearSkyAndSun) {
  lighting::Study study = grey_study(large_square(0.0), 0.2);
  const Vector towards = mesh::normalized({1, -2, 1.5});
  study.sky = lighting::sky_of(lighting::cie_general_sky(12, towards), 12'000.0);
  study.sky.sun = {.towards = towards, .normal_illuminance_lux = 50'000.0};
  expect_within_noise(trace_one(study, {0, 0, 1}, {0, 0, 1}, {.paths = 20'000}), 12'000.0 + 50'000.0 * towards.z);
}

TEST(PathTracer, PaneMirrorsTheSunOntoASensorBeforeIt) {
  mesh::Model model;
  support::add_quad(model, {-100, 0, -100}, {100, 0, -100}, {100, 0, 100}, {-100, 0, 100});
  lighting::Study study = grey_study(model, 0.0);
  study.materials.front().glazing = lighting::Glazing{.transmittance_normal = 0.7};
  study.sky.sun = {.towards = mesh::normalized({0, -1, 1}), .normal_illuminance_lux = 1000.0};
  const double cosine = std::sqrt(0.5);
  const Traced before = trace_one(study, {0, -1, 0}, {0, 1, 0}, {.paths = 2});
  EXPECT_NEAR(before.illuminance_lux, 1000.0 * cosine * pane_optics(0.7, cosine).reflectance, 1e-6);
  const Traced behind = trace_one(study, {0, 1, 0}, {0, -1, 0}, {.paths = 2});
  EXPECT_NEAR(behind.illuminance_lux, 1000.0 * cosine * pane_optics(0.7, cosine).transmittance, 1e-6);
}

TEST(PathTracer, SensorOnItsSideSeesSkyAndGroundBeyondTheModel) {
  lighting::Study study = grey_study(large_square(-1000.0), 0.0);
  study.model = support::box_room(0.01, 0.01, 0.01);  // a speck: nothing but sky and the ground beyond is seen
  study.materials = grey_study(study.model, 0.0).materials;
  study.sky.type = lighting::Sky::Type::kCieOvercast;
  study.sky.ground_reflectance = 0.3;
  const double from_sky = (std::numbers::pi / 6.0 + 4.0 / 9.0) / (7.0 * std::numbers::pi / 9.0);
  expect_within_noise(trace_one(study, {5, 0, 0}, {1, 0, 0}, {.paths = 40'000}), 10'000.0 * (from_sky + 0.15));
}

TEST(PathTracer, WidePaneTransmitsItsHemisphericalShareOfAUniformSky) {
  lighting::Study study = grey_study(large_square(0.05), 0.0);
  study.materials[0].glazing = lighting::Glazing{.transmittance_normal = 0.70, .panes = 1};
  study.sky = {.type = lighting::Sky::Type::kUniform, .horizontal_illuminance_lux = 1000.0, .ground_reflectance = 0.0};
  const Traced under = trace_one(study, {0, 0, 0}, {0, 0, 1}, {.paths = 100'000});
  EXPECT_NEAR(under.illuminance_lux, 619.5, 0.5 + 4.0 * under.standard_error_lux);
}

TEST(PathTracer, PaneMirrorsTheSkyOntoASensorThatFacesIt) {
  lighting::Study study = grey_study(large_square(0.0), 0.0);
  study.materials[0].glazing = lighting::Glazing{.transmittance_normal = 0.70, .panes = 1};
  study.sky = {.type = lighting::Sky::Type::kUniform, .horizontal_illuminance_lux = 1000.0, .ground_reflectance = 0.0};
  const Traced above = trace_one(study, {0, 0, 0.05}, {0, 0, -1}, {.paths = 100'000});
  EXPECT_NEAR(above.illuminance_lux, 125.0, 0.5 + 4.0 * above.standard_error_lux);
}

TEST(PathTracer, ClosedBoxOfOneReflectanceAndEmissionIsAFurnace) {
  lighting::Study study = grey_study(support::box_room(3, 4, 2.5), 0.6);
  for (lighting::Material& material : study.materials) shine(material, 100.0);
  for (const bool sampled : {false, true}) {
    const TraceOptions options{.paths = 20'000, .sample_emitters = sampled};
    expect_within_noise(trace_one(study, {1.0, 1.5, 1.0}, {0, 0, 1}, options), 100.0 / (1.0 - 0.6));
  }
}

TEST(PathTracer, PointSourceInAClosedCubeGivesThePublishedTotalIlluminance) {
  lighting::Study study = grey_study(support::box_room(4, 4, 4), 0.5);
  study.luminaires.push_back(clerestory::test::isotropic_lamp({2, 2, 2}, 10'000.0 / (4.0 * std::numbers::pi)));
  expect_within_noise(trace_one(study, {2, 2, 0.0001}, {0, 0, 1}, {.paths = 20'000}), 310.98);
  expect_within_noise(trace_one(study, {1, 1, 0.0001}, {0, 0, 1}, {.paths = 20'000}), 216.08);
}

TEST(PathTracer, ThreadsDoNotChangeAnything) {
  lighting::Study study = grey_study(large_square(0.0), 0.2);
  study.sky.type = lighting::Sky::Type::kCieOvercast;
  const TracedScene scene = traced_scene(study);
  const std::vector<Point> at(10, Point{0, 0, 1});
  const std::vector<Vector> up(10, Vector{0, 0, 1});
  const auto one = trace_illuminance(scene, at, up, {.paths = 100, .threads = 1});
  const auto three = trace_illuminance(scene, at, up, {.paths = 100, .threads = 3});
  for (std::size_t i = 0; i < at.size(); ++i) EXPECT_EQ(one[i].illuminance_lux, three[i].illuminance_lux);
  EXPECT_NE(one[0].illuminance_lux, one[1].illuminance_lux) << "sensors have random numbers of their own";
}

/// Traces every n-th sensor of a reference scene and compares: the mean and the spread of z must be those of pure noise.
void expect_agreement(const std::string& name, std::size_t stride, std::size_t paths) {
  const lighting::Study study = validation_study(name);
  const Reference reference = validation_reference(name);
  const lighting::GridRequest& grid = study.grids.front();
  std::vector<Point> positions;
  std::vector<Vector> normals;
  std::vector<double> expected;
  std::vector<double> expected_error;
  for (std::size_t i = stride / 2; i < grid.points.size(); i += stride) {
    positions.push_back(grid.points[i]);
    normals.push_back(grid.normals[i]);
    expected.push_back(reference.illuminance_lux.at(i));
    expected_error.push_back(reference.standard_error_lux.at(i));
  }
  const auto traced = trace_illuminance(traced_scene(study), positions, normals, {.paths = paths});
  std::vector<double> values;
  std::vector<double> errors;
  for (const Traced& t : traced) {
    values.push_back(t.illuminance_lux);
    errors.push_back(t.standard_error_lux);
  }
  const Comparison result = compare(values, errors, expected, expected_error);
  print(name, result);
  const auto n = static_cast<double>(values.size());
  // Four standard deviations of the mean of n squares of standard normal numbers.
  EXPECT_NEAR(result.rms_z * result.rms_z, 1.0, 4.0 * std::sqrt(2.0 / n)) << name;
  EXPECT_LE(std::abs(result.mean_difference), 4.0 * result.mean_difference_error) << name;
}

TEST(PathTracer, AgreesWithTheLampRoomWithinItsNoise) {
  CLERESTORY_NEEDS_VALIDATION("lamp-room");
  expect_agreement("lamp-room", 1, 2048);
}

TEST(PathTracer, AgreesWithTheOfficeWithinItsNoise) {
  CLERESTORY_NEEDS_VALIDATION("office");
  expect_agreement("office", 7, 65'536);
}

/// A room of 4 m × 5 m × 2.8 m with a glazed window of 2.4 m × 1.5 m to the south and a table before it.
lighting::Study sunny_room() {
  mesh::Model model;
  support::add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 5, 0}, {0, 5, 0}, {.material = "floor"});
  support::add_quad(model, {0, 0, 2.8}, {0, 5, 2.8}, {4, 5, 2.8}, {4, 0, 2.8}, {.material = "ceiling"});
  support::add_quad(model, {0, 5, 0}, {4, 5, 0}, {4, 5, 2.8}, {0, 5, 2.8});
  support::add_quad(model, {0, 0, 0}, {0, 5, 0}, {0, 5, 2.8}, {0, 0, 2.8});
  support::add_quad(model, {4, 0, 0}, {4, 0, 2.8}, {4, 5, 2.8}, {4, 5, 0});
  support::add_polygon(model, {{0, 0, 0}, {0, 0, 2.8}, {4, 0, 2.8}, {4, 0, 0}}, {},
                       {{{0.8, 0, 0.9}, {3.2, 0, 0.9}, {3.2, 0, 2.4}, {0.8, 0, 2.4}}});
  support::add_quad(model, {0.8, 0, 0.9}, {3.2, 0, 0.9}, {3.2, 0, 2.4}, {0.8, 0, 2.4}, {.material = "glass"});
  support::add_table(model, {1.2, 1.0, 0.0});
  lighting::Study study = grey_study(model, 0.5);
  material(study, "floor").front.reflectance = lighting::Spectrum{0.25F};
  material(study, "ceiling").front.reflectance = lighting::Spectrum{0.8F};
  material(study, "glass").glazing = lighting::Glazing{.transmittance_normal = 0.7};
  add_sensors(study, cell_centres({0.2, 0.2, 0.85}, 3.6, 4.6, 12), {0, 0, 1});
  return study;
}

/// The program against the oracle, at 2 %: the mean within 1 %, the errors honest as far as so many sensors can tell.
void expect_as_traced(const std::string& what, const lighting::Study& study) {
  const lighting::GridResult grid = answer(study).grids.at(0);
  const Comparison result = compare(grid, traced_reference(study, 16'384));
  print(what, result);
  EXPECT_LE(std::abs(result.bias), 0.01) << what;
  EXPECT_GE(result.rms_z, 0.5) << what;
  EXPECT_LE(result.rms_z, 1.2) << what;
  // Of n sensors with 95 % each, so many fewer are within two standard deviations.
  EXPECT_GE(result.covered, 0.95 - 2.0 * std::sqrt(0.95 * 0.05 / static_cast<double>(result.count))) << what;
}

TEST(PathTracer, SunAndSkyThroughAWindowAreAsTheProgramSays) {
  lighting::Study study = sunny_room();
  const Vector towards = mesh::normalized({0.35, -1.0, 0.75});
  for (const int type : {1, 12}) {
    study.sky = lighting::sky_of(lighting::cie_general_sky(type, towards), 15'000.0);
    study.sky.sun = {.towards = towards, .normal_illuminance_lux = 40'000.0};
    expect_as_traced(type == 1 ? "overcast sky and sun" : "clear sky and sun", study);
  }
}

}  // namespace
}  // namespace clerestory::test
