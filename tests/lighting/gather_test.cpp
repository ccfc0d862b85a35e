// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/gather.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lighting/dark_share.h"
#include "tests/lighting/stages.h"
#include "tests/support/blocked_lamp.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

/// Evaluates a solved study at some places, model coordinates.
Gathered gathered(const test::Solved& solved, const std::vector<Point>& points, const std::vector<Vector>& normals,
                  double accuracy = 0.02) {
  std::vector<Point> local;
  for (const Point& p : points) local.push_back(solved.local(p));
  NoProgress nobody;
  return gather(solved.solution, solved.transport.errors, {local, normals}, accuracy, 1, nobody);
}

/// The same at upright cylinders.
Gathered gathered_round(const test::Solved& solved, const std::vector<Point>& points, double accuracy = 0.02) {
  std::vector<Point> local;
  for (const Point& p : points) local.push_back(solved.local(p));
  const std::vector<Vector> axes(points.size(), Vector{0, 0, 1});
  NoProgress nobody;
  return gather(solved.solution, solved.transport.errors, {local, axes, true}, accuracy, 1, nobody);
}

TEST(Gather, AreaLampInABlackRoomMatchesCie171Case53) {
  mesh::Model model = support::box_room(4, 4, 3);
  support::add_quad(model, {1.5, 1.5, 2.9999}, {1.5, 2.5, 2.9999}, {2.5, 2.5, 2.9999}, {2.5, 1.5, 2.9999},
                    {"lamp", "lamp"});
  Study study = test::study_of(std::move(model), 0.0, {2, 2, 0.5});
  test::shine(test::material(study, "lamp"), 1000.0 * std::numbers::pi);
  const test::Solved solved(study);
  struct Case {
    Point at;
    Vector normal;
    double lux;
  };
  for (const Case& k : {Case{{2, 0, 2.75}, {0, 1, 0}, 32.677}, Case{{2, 0, 2.25}, {0, 1, 0}, 75.194},
                        Case{{2, 0, 1.75}, {0, 1, 0}, 81.323}, Case{{2, 0, 1.25}, {0, 1, 0}, 69.061},
                        Case{{2, 0, 0.75}, {0, 1, 0}, 53.404}, Case{{2, 0, 0.25}, {0, 1, 0}, 40.002},
                        Case{{2, 0.25, 0}, {0, 0, 1}, 61.424}, Case{{2, 0.75, 0}, {0, 0, 1}, 79.255},
                        Case{{2, 1.25, 0}, {0, 0, 1}, 95.667}, Case{{2, 1.75, 0}, {0, 0, 1}, 105.778}}) {
    // The lamp hangs 0.1 mm under the ceiling.
    EXPECT_NEAR(gathered(solved, {k.at}, {k.normal}).illuminance_lux[0], k.lux, 0.02) << k.at.y << ", " << k.at.z;
  }
}

TEST(Gather, PointSourceIsExactAndShadowed) {
  mesh::Model model = support::box_room(4, 4, 3);
  support::add_quad(model, {0, 0, 1}, {1, 0, 1}, {1, 4, 1}, {0, 4, 1}, {"shelf", "shelf"});
  Study study = test::study_of(std::move(model), 0.0, {2, 2, 0.5});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({0.5, 2, 2.5}, 1000.0));
  const Gathered lit = gathered(test::Solved(study), {{3, 2, 0}, {0.5, 2, 0.5}}, {{0, 0, 1}, {0, 0, 1}});
  EXPECT_NEAR(lit.illuminance_lux[0], 1000.0 * 2.5 / std::pow(12.5, 1.5), 1e-2);
  EXPECT_NEAR(lit.illuminance_lux[1], 0.0, 1e-4);
}

TEST(Gather, ACylinderReceivesOfAPointSourceByTheSineOverPi) {
  Study study = test::study_of(support::box_room(4, 4, 3), 0.0, {2, 2, 0.5});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({0.5, 2, 2.5}, 1000.0));
  const Gathered lit = gathered_round(test::Solved(study), {{3, 2, 1.2}, {0.5, 2, 1.2}});
  const double r2 = 2.5 * 2.5 + 1.3 * 1.3;
  EXPECT_NEAR(lit.illuminance_lux[0], 1000.0 / r2 * 2.5 / std::sqrt(r2) / std::numbers::pi, 1e-2);
  EXPECT_NEAR(lit.illuminance_lux[1], 0.0, 1e-3);
}

TEST(Gather, ACylinderReceivesTheMeanOfThePlanesAboutIt) {
  const test::Solved solved = [] {
    mesh::Model model = support::box_room(4, 4, 3);
    support::add_table(model, {1.2, 1.6, 0.0});
    support::add_quad(model, {1.5, 1.5, 2.5}, {1.5, 2.5, 2.5}, {2.5, 2.5, 2.5}, {2.5, 1.5, 2.5}, {"lamp", "lamp"});
    Study study = test::study_of(std::move(model), 0.5, {1, 1, 1.2});
    test::shine(test::material(study, "lamp"), 1000.0);
    return test::Solved(study);
  }();
  constexpr int kPlanes = 15;
  const Point at{1.0, 3.0, 1.2};
  std::vector<Vector> normals;
  for (int k = 0; k < kPlanes; ++k) {
    const double phi = 2.0 * std::numbers::pi * k / kPlanes;
    normals.push_back({std::cos(phi), std::sin(phi), 0.0});
  }
  const Gathered planes = gathered(solved, std::vector<Point>(kPlanes, at), normals, 0.005);
  double mean = 0.0;
  for (const float lux : planes.illuminance_lux) mean += lux / kPlanes;
  const Gathered round = gathered_round(solved, {at}, 0.005);
  EXPECT_NEAR(round.illuminance_lux[0] / mean, 1.0, 0.01);
  EXPECT_GT(round.error_lux[0], 0.0F);
}

Study furnace() {
  Study study = test::study_of(support::box_room(4, 5, 3), 0.5, {2, 2, 1});
  for (Material& m : study.materials) test::shine(m, 20.0);
  return study;
}

TEST(Gather, SensorsOnSurfacesInCornersAndInTheOpenSeeTheFurnace) {
  const test::Solved solved(furnace());
  const Gathered e =
      gathered(solved, {{2, 2, 0}, {0, 2, 1}, {3.9999, 4.9999, 3}, {1e-4, 1e-4, 1e-4}, {2, 2, 1.5}, {2, 2, 1.5}},
               {{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {0, 0.6, -0.8}, {1, 0, 0}});
  for (const float lux : e.illuminance_lux) EXPECT_NEAR(lux, 40.0, 0.04);
  for (const float lux : gathered_round(solved, {{2, 2, 1.2}, {0.1, 0.1, 2.9}}).illuminance_lux)
    EXPECT_NEAR(lux, 40.0, 0.04);
}

TEST(Gather, IndirectLightIsWhatSurfacesReflect) {
  // Of the furnace's 40 lx half are reflected, half the surfaces' own light.
  const test::Solved solved(furnace());
  const Gathered e = gathered(solved, {{2, 2, 1.5}}, {{1, 0, 0}});
  EXPECT_NEAR(e.indirect_lux[0], 20.0, 0.2);
  EXPECT_GE(e.indirect_error_lux[0], 0.0F);
}

/// A room with a lamp over a table, which hides part of it.
test::Solved table_room(double accuracy) {
  mesh::Model model = support::box_room(4, 4, 3);
  support::add_table(model, {1.2, 1.6, 0.0});
  support::add_quad(model, {1.5, 1.5, 2.5}, {1.5, 2.5, 2.5}, {2.5, 2.5, 2.5}, {2.5, 1.5, 2.5}, {"lamp", "lamp"});
  Study study = test::study_of(std::move(model), 0.5, {1, 1, 0.01});
  test::shine(test::material(study, "lamp"), 1000.0);
  study.accuracy.target = accuracy;
  return test::Solved(study);
}

/// Sensors near the floor, around and under the table.
struct FloorSensors {
  std::vector<Point> points;
  std::vector<Vector> normals;
  FloorSensors() {
    for (int i = 0; i < 64; ++i) {
      points.push_back({0.25 + 0.5 * (i % 8), 0.25 + 0.5 * (i / 8), 0.01});
      normals.push_back({0, 0, 1});
    }
  }
};

double rms_relative_error(const Gathered& e) {
  double sum = 0.0;
  for (std::size_t i = 0; i < e.error_lux.size(); ++i) {
    const double r = e.error_lux[i] / e.illuminance_lux[i];
    sum += r * r / static_cast<double>(e.error_lux.size());
  }
  return std::sqrt(sum);
}

TEST(Gather, EachSensorKeepsTheAccuracyOfItsOwnLight) {
  // A lamp close below the ceiling makes a small bright patch there, of which the first rays may find far too much.
  mesh::Model model = support::box_room(6, 6, 3);
  support::add_quad(model, {0.5, 0.5, 2.8}, {0.7, 0.5, 2.8}, {0.7, 0.7, 2.8}, {0.5, 0.7, 2.8}, {"lamp", "lamp"});
  Study study = test::study_of(std::move(model), 0.2, {3, 3, 0.8});
  test::shine(test::material(study, "lamp"), 50000.0);
  const test::Solved solved(study);
  std::vector<Point> points;
  for (double x = 0.25; x < 6.0; x += 0.5) {
    for (double y = 0.25; y < 6.0; y += 0.5) points.push_back({x, y, 0.8});
  }
  constexpr double kAccuracy = 0.08;
  const Gathered lit = gathered(solved, points, std::vector<Vector>(points.size(), {0, 0, 1}), kAccuracy);
  double mean = 0.0;
  for (const float lux : lit.illuminance_lux) mean += lux / static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double level = std::max<double>(lit.illuminance_lux[i], kDarkShare * mean);
    EXPECT_LE(lit.error_lux[i], kAccuracy * level) << points[i].x << " " << points[i].y;
  }
}

TEST(Gather, StatedErrorShrinksWithTheAccuracyAsked) {
  const FloorSensors sensors;
  const double coarse = rms_relative_error(gathered(table_room(0.08), sensors.points, sensors.normals, 0.08));
  const double fine = rms_relative_error(gathered(table_room(0.02), sensors.points, sensors.normals, 0.02));
  EXPECT_LT(coarse, 0.08);
  EXPECT_LT(fine, 0.02);
  EXPECT_GT(coarse / fine, 2.0);
}

TEST(Gather, CoarseValuesLieWithinTheirErrorOfFineOnes) {
  const FloorSensors sensors;
  const Gathered coarse = gathered(table_room(0.08), sensors.points, sensors.normals, 0.08);
  const Gathered fine = gathered(table_room(0.01), sensors.points, sensors.normals, 0.01);
  std::size_t outside = 0;
  for (std::size_t i = 0; i < sensors.points.size(); ++i) {
    const double z =
        (coarse.illuminance_lux[i] - fine.illuminance_lux[i]) / std::hypot(coarse.error_lux[i], fine.error_lux[i]);
    outside += std::abs(z) > 2.0 ? 1 : 0;
  }
  EXPECT_LE(outside, sensors.points.size() / 10) << "5 % are to be expected";
}

TEST(Gather, DoesNotDependOnWhichSensorsAreAskedTogetherInOrder) {
  const test::Solved solved = table_room(0.08);
  const FloorSensors sensors;
  const Gathered once = gathered(solved, sensors.points, sensors.normals, 0.08);
  const Gathered again = gathered(solved, sensors.points, sensors.normals, 0.08);
  EXPECT_EQ(once.illuminance_lux, again.illuminance_lux);
  EXPECT_EQ(once.error_lux, again.error_lux);
}

TEST(Gather, UnderTheOpenSkyThereIsItsHorizontalIlluminance) {
  mesh::Model model;
  support::add_quad(model, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {"ground", "ground"});
  Study study = test::study_of(std::move(model), 0.2, {1, 1, 0.5});
  study.sky.type = Sky::Type::kCieOvercast;
  const Gathered e = gathered(test::Solved(study), {{1, 1, 0.5}}, {{0, 0, 1}});
  EXPECT_NEAR(e.illuminance_lux[0], 10'000.0, 3.0 * e.error_lux[0] + 1.0);
  EXPECT_LT(e.error_lux[0], 200.0);
}

TEST(Gather, OpeningIsSeenOnceThroughAirAndThroughGlass) {
  // A uniform sky through a roof of 4 m × 4 m over a black room, seen from the middle of the floor: four corners of 2 × 2 at 3.
  const double a = 2.0 / 3.0;
  const double s = std::sqrt(1.0 + a * a);
  const double factor = 4.0 * (2.0 * a / s * std::atan(a / s)) / (2.0 * std::numbers::pi);
  for (const bool glazed : {false, true}) {
    Study study = test::study_of(support::box_room(4, 4, 3), 0.0, {2, 2, 0.5});
    study.sky.type = Sky::Type::kUniform;
    Material& roof = test::material(study, "ceiling");
    roof.front = roof.back = {};
    roof.opening = !glazed;
    if (glazed) roof.glazing = Glazing{};
    const Gathered e = gathered(test::Solved(study), {{2, 2, 0}}, {{0, 0, 1}});
    if (glazed) {
      EXPECT_LT(e.illuminance_lux[0], 0.70 * 10'000.0 * factor);
      EXPECT_GT(e.illuminance_lux[0], 0.67 * 10'000.0 * factor);
    } else {
      EXPECT_NEAR(e.illuminance_lux[0], 10'000.0 * factor, 5.0);
    }
  }
}

/// A black room of 6 m × 4 m × 3 m whose ceiling gives 10,000 lm/m², and a sheet at 1.5 m over all of it but for a slit along x.
struct SlitRoom {
  std::vector<Point> ceiling{{0, 0, 3}, {6, 0, 3}, {6, 4, 3}, {0, 4, 3}};
  std::vector<std::vector<Point>> sheet;
  mesh::Model model = support::box_room(6, 4, 3);
  std::vector<Point> points;
  std::vector<Vector> normals;

  explicit SlitRoom(double width_m) {
    for (const auto& [low, high] : {std::array{0.0, 2.0}, std::array{2.0 + width_m, 4.0}}) {
      sheet.push_back({{0, low, 1.5}, {6, low, 1.5}, {6, high, 1.5}, {0, high, 1.5}});
      support::add_polygon(model, sheet.back(), {"sheet", "sheet"});
    }
    for (const double y : {0.6, 1.1, 1.7, 2.0, 2.3, 3.3}) {
      points.push_back({2.2, y, 0.3});
      normals.push_back({0, 0, 1});
    }
  }
  [[nodiscard]] Study lit_by_ceiling() const {
    Study study = test::study_of(model, 0.0, {3, 2, 0.5});
    test::shine(test::material(study, "ceiling"), 10'000.0);
    return study;
  }
  [[nodiscard]] double exact(std::size_t sensor) const {
    return support::exact_illuminance({.lamp = ceiling, .exitance_lm_m2 = 10'000.0, .blockers = sheet}, points[sensor],
                                      normals[sensor]);
  }
};

TEST(Gather, LampThroughASlitIsExact) {
  for (const double width_m : {0.05, 0.01}) {
    const SlitRoom room(width_m);
    const Gathered e = gathered(test::Solved(room.lit_by_ceiling()), room.points, room.normals);
    for (std::size_t i = 0; i < room.points.size(); ++i) {
      ASSERT_GT(room.exact(i), 1.0);
      EXPECT_NEAR(e.illuminance_lux[i], room.exact(i), 1e-3 * room.exact(i)) << width_m << ' ' << i;
    }
  }
}

TEST(Gather, LampThroughASlitBehindAnAirPolygonIsFoundByRays) {
  for (const double width_m : {0.05, 0.01}) {
    SlitRoom room(width_m);
    support::add_quad(room.model, {0, 0, 2}, {6, 0, 2}, {6, 4, 2}, {0, 4, 2}, {"air", "air"});
    Study study = room.lit_by_ceiling();
    test::leave_open(test::material(study, "air"));
    const Gathered e = gathered(test::Solved(study), room.points, room.normals);
    for (std::size_t i = 0; i < room.points.size(); ++i) {
      EXPECT_NEAR(e.illuminance_lux[i], room.exact(i), 0.05 * room.exact(i)) << width_m << ' ' << i;
      EXPECT_NEAR(e.illuminance_lux[i], room.exact(i), 3.0 * e.error_lux[i]) << width_m << ' ' << i;
    }
  }
}

TEST(Gather, SkyThroughASlitIsFoundByRays) {
  for (const double width_m : {0.05, 0.01}) {
    const SlitRoom room(width_m);
    Study study = test::study_of(room.model, 0.0, {3, 2, 0.5});
    study.sky.type = Sky::Type::kUniform;
    test::leave_open(test::material(study, "ceiling"));
    const Gathered e = gathered(test::Solved(study), room.points, room.normals);
    for (std::size_t i = 0; i < room.points.size(); ++i) {
      EXPECT_NEAR(e.illuminance_lux[i], room.exact(i), 0.05 * room.exact(i)) << width_m << ' ' << i;
      EXPECT_NEAR(e.illuminance_lux[i], room.exact(i), 3.0 * e.error_lux[i]) << width_m << ' ' << i;
    }
  }
}

TEST(Gather, AnOpeningOutOfSightTakesOneRayAReplicate) {
  const auto rays = [](bool open) {
    mesh::Model model = support::box_room(4, 4, 3);
    support::add_quad(model, {0, 0, 2}, {2, 0, 2}, {2, 4, 2}, {0, 4, 2}, {"sheet", "sheet1"});
    support::add_quad(model, {2, 0, 2}, {4, 0, 2}, {4, 4, 2}, {2, 4, 2}, {"sheet", "sheet2"});
    Study study = test::study_of(std::move(model), 0.5, {2, 2, 0.5});
    study.sky.type = Sky::Type::kUniform;
    test::shine(test::material(study, "floor"), 1000.0);
    if (open) test::leave_open(test::material(study, "ceiling"));
    const test::Solved solved(study);
    const std::size_t before = solved.scene.rays->use().rays;
    const Gathered e = gathered(solved, {{2, 1, 0.5}}, {{0, 0, 1}});
    EXPECT_GT(e.illuminance_lux[0], 0.0F);
    return solved.scene.rays->use().rays - before;
  };
  EXPECT_EQ(rays(true), rays(false) + kReplicates);
}

TEST(Gather, BehindACrowdRaysThatAllMissLeaveAnErrorBehindASheetNone) {
  for (const std::size_t strips : {std::size_t{1}, std::size_t{200}}) {
    mesh::Model model = support::box_room(6, 4, 3);
    for (std::size_t i = 0; i < strips; ++i) {
      const auto y = [&](std::size_t k) { return 4.0 * static_cast<double>(k) / static_cast<double>(strips); };
      support::add_quad(model, {0, y(i), 1.5}, {6, y(i), 1.5}, {6, y(i + 1), 1.5}, {0, y(i + 1), 1.5},
                        {"sheet", "sheet" + std::to_string(i)});
    }
    Study study = test::study_of(std::move(model), 0.0, {3, 2, 0.5});
    test::shine(test::material(study, "ceiling"), 10'000.0);
    study.accuracy.target = 0.08;
    const Gathered e = gathered(test::Solved(study), {{3, 2, 0.5}}, {{0, 0, 1}});
    EXPECT_EQ(e.illuminance_lux[0], 0.0F);
    if (strips == 1) {
      EXPECT_EQ(e.error_lux[0], 0.0F);
    } else {
      EXPECT_GT(e.error_lux[0], 0.0F);
      EXPECT_LT(e.error_lux[0], 10'000.0F / 500.0F);
    }
  }
}

}  // namespace
}  // namespace clerestory::lighting
