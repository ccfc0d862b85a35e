// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/gather.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/lighting/stages.h"
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
  return gather(solved.solution, solved.transport.errors, local, normals, accuracy, 1, nobody);
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
  study.point_sources.push_back({.at = {0.5, 2, 2.5}, .intensity_cd = 1000.0});
  const Gathered lit = gathered(test::Solved(study), {{3, 2, 0}, {0.5, 2, 0.5}}, {{0, 0, 1}, {0, 0, 1}});
  EXPECT_NEAR(lit.illuminance_lux[0], 1000.0 * 2.5 / std::pow(12.5, 1.5), 1e-2);
  EXPECT_NEAR(lit.illuminance_lux[1], 0.0, 1e-4);
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

}  // namespace
}  // namespace clerestory::lighting
