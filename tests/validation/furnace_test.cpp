// SPDX-License-Identifier: GPL-3.0-or-later
// A closed shape of one reflectance and one emission everywhere has the radiosity M/(1-ρ) everywhere, exactly, whatever its shape
// [science page, section 11]. And what a run says of its own energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "io/study_file.h"
#include "tests/support/places.h"
#include "tests/support/shapes.h"
#include "tests/support/validation_scenes.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

constexpr double kEmission_lm_m2 = 100.0;
constexpr double kReflectance = 0.6;
constexpr double kExact = kEmission_lm_m2 / (1.0 - kReflectance);

lighting::Study furnace(mesh::Model model, double accuracy) {
  lighting::Study study = grey_study(std::move(model), kReflectance);
  for (lighting::Material& m : study.materials) shine(m, kEmission_lm_m2);
  study.accuracy.target = accuracy;
  return study;
}

/// How far the radiosity of the shining sides lies from the exact value, relative.
struct Deviation {
  double mean = 0.0;
  double rms = 0.0;
  double largest = 0.0;
};

double area_m2(const lighting::SurfaceResult& surfaces, std::size_t cell) {
  const auto& c = surfaces.cells[cell];
  return 0.5 *
         norm(cross(surfaces.points[c[1]] - surfaces.points[c[0]], surfaces.points[c[2]] - surfaces.points[c[0]]));
}

/// Whether a cell is the floor under a piece of furniture, or what else lies inside it: that place is dark.
bool covered(const lighting::SurfaceResult& surfaces, std::size_t cell, const std::vector<mesh::Box>& furniture) {
  const auto& c = surfaces.cells[cell];
  const mesh::Point& a = surfaces.points[c[0]];
  const mesh::Point p = a + ((surfaces.points[c[1]] - a) + (surfaces.points[c[2]] - a)) / 3.0;
  constexpr double kInside_m = 1e-4;
  return std::any_of(furniture.begin(), furniture.end(), [&](const mesh::Box& box) {
    return p.x > box.low.x + kInside_m && p.x < box.high.x - kInside_m && p.y > box.low.y + kInside_m &&
           p.y < box.high.y - kInside_m && p.z > box.low.z - kInside_m && p.z < box.high.z;
  });
}

Deviation radiosity_deviation(const lighting::SurfaceResult& surfaces, const std::vector<mesh::Box>& furniture = {}) {
  Deviation d;
  double area = 0.0;
  for (std::size_t c = 0; c < surfaces.cells.size(); ++c) {
    if (surfaces.side[c] != 0) continue;  // backs do not shine, and see nothing that does
    if (covered(surfaces, c, furniture)) continue;
    const double relative = surfaces.radiosity_lm_m2[c] / kExact - 1.0;
    const double a = area_m2(surfaces, c);
    area += a;
    d.mean += a * relative;
    d.rms += a * relative * relative;
    d.largest = std::max(d.largest, std::abs(relative));
  }
  return {d.mean / area, std::sqrt(d.rms / area), d.largest};
}

void print_run(const char* what, const lighting::Results& results, const Deviation& d) {
  std::printf(
      "[ FIGURES  ] %s: radiosity mean %+.1e, rms %.1e, largest %.1e; balance %+.1e, reciprocity %.1e, closure %.1e\n",
      what, d.mean, d.rms, d.largest, results.energy.residual, results.energy.reciprocity, results.energy.closure);
}

/// How far sensors lie from the exact value, relative; each must see the exact radiosity wherever it looks.
Deviation sensor_deviation(const lighting::Results& results) {
  Deviation d;
  const auto& values = results.grids.at(0).illuminance_lux;
  const auto n = static_cast<double>(values.size());
  for (const float e : values) {
    const double relative = e / kExact - 1.0;
    d.mean += relative / n;
    d.rms += relative * relative / n;
    d.largest = std::max(d.largest, std::abs(relative));
  }
  d.rms = std::sqrt(d.rms);
  return d;
}

void print_sensors(const Deviation& d) {
  std::printf("[ FIGURES  ]   sensors: mean %+.1e, rms %.1e, largest %.1e\n", d.mean, d.rms, d.largest);
}

/// Sensors all over a room, looking up, sideways and down: together they see all of its surfaces. Links are made as fine as the sensors
/// need, and surfaces that none of them sees stay coarse.
void add_sensors_everywhere(lighting::Study& study, const mesh::Point& low, double width_m, double depth_m) {
  const auto points = cell_centres(low, width_m, depth_m, 6);
  for (const mesh::Vector& n : {mesh::Vector{0, 0, 1}, mesh::Vector{1, 0, 0}, mesh::Vector{-1, 0, 0},
                                mesh::Vector{0, 1, 0}, mesh::Vector{0, -1, 0}, mesh::Vector{0, 0, -1}})
    add_sensors(study, points, n);
}

struct Furnace {
  lighting::Results results;
  Deviation surfaces;
  Deviation sensors;
};

Furnace box_furnace(double accuracy) {
  lighting::Study study = furnace(support::box_room(4, 5, 3), accuracy);
  add_sensors_everywhere(study, {0.1, 0.1, 1.1}, 3.8, 4.8);
  Furnace f{answer(study), {}, {}};
  f.surfaces = radiosity_deviation(f.results.surfaces);
  f.sensors = sensor_deviation(f.results);
  print_run("box", f.results, f.surfaces);
  print_sensors(f.sensors);
  return f;
}

TEST(Furnace, ConvexBoxIsExactToOneInTenThousandAtEveryElementAtAnyAccuracy) {
  for (const double accuracy : {0.08, 0.02, 0.005}) {
    const Furnace f = box_furnace(accuracy);
    EXPECT_LE(f.surfaces.largest, 1e-4) << accuracy;
    EXPECT_LE(std::abs(f.sensors.mean), 1e-4) << accuracy;
    EXPECT_LE(std::abs(f.results.energy.residual), 1e-4) << accuracy;
    EXPECT_LE(f.results.energy.closure, 1e-4) << accuracy;
    EXPECT_LE(f.results.energy.reciprocity, 1e-4) << accuracy;
  }
}

/// Sensors look at links as good as the accuracy asked makes them: one in ten thousand at every single sensor needs an accuracy of that
/// order.
TEST(Furnace, ConvexBoxIsExactToOneInTenThousandAtEverySensorAtAFineAccuracy) {
  const Furnace f = box_furnace(0.002);
  EXPECT_LE(f.sensors.largest, 1e-4);
  EXPECT_LE(f.surfaces.largest, 1e-4);
}

/// Scenes where visibility is sampled: a quarter of the accuracy asked, on the mean of the sensors and of the surfaces by area. A single
/// sensor samples how much it sees of each shining surface, and keeps what an accuracy promises.
void expect_furnace(const char* what, lighting::Study study, const std::vector<mesh::Box>& furniture = {}) {
  const double bound = study.accuracy.target / 4;
  const lighting::Results results = answer(study);
  const Deviation surfaces = radiosity_deviation(results.surfaces, furniture);
  const Deviation sensors = sensor_deviation(results);
  print_run(what, results, surfaces);
  print_sensors(sensors);
  EXPECT_LE(std::abs(surfaces.mean), bound) << what;
  EXPECT_LE(std::abs(sensors.mean), bound) << what;
  EXPECT_LE(sensors.rms, study.accuracy.target) << what;
  EXPECT_LE(std::abs(results.energy.residual), bound) << what;
  EXPECT_LE(results.energy.closure, bound) << what;
  EXPECT_LE(results.energy.reciprocity, bound) << what;
}

TEST(Furnace, LRoomIsExactToAQuarterOfTheAccuracy) {
  for (const double accuracy : {0.08, 0.02, 0.01}) {
    lighting::Study study = furnace(support::l_room(), accuracy);
    add_sensors_everywhere(study, {0.1, 0.1, 0.9}, 1.8, 3.8);
    add_sensors_everywhere(study, {2.1, 0.1, 0.9}, 1.8, 1.8);
    expect_furnace("L-room", std::move(study));
  }
}

TEST(Furnace, FurnishedRoomIsExactToAQuarterOfTheAccuracy) {
  mesh::Model model = support::box_room(4, 5, 3);
  std::vector<mesh::Box> furniture;
  for (const mesh::Point& corner : {mesh::Point{1.0, 0.5, 0.0}, mesh::Point{1.2, 3.0, 0.0}}) {
    support::add_table(model, corner);
    for (const double dx : {0.0, 1.55})
      for (const double dy : {0.0, 0.75})
        furniture.push_back({corner + mesh::Vector{dx, dy, 0}, corner + mesh::Vector{dx + 0.05, dy + 0.05, 0.7201}});
  }
  const mesh::Box shelf{{2.9, 2.0, 0.0}, {3.6, 2.4, 1.8}};
  support::add_box(model, shelf.low, shelf.high, {.material = "wood", .part = "shelf"});
  furniture.push_back({shelf.low, shelf.high - mesh::Vector{0, 0, 1e-3}});
  for (const double accuracy : {0.08, 0.02, 0.01}) {
    lighting::Study study = furnace(model, accuracy);
    add_sensors_everywhere(study, {0.1, 0.1, 0.9}, 2.7, 4.8);
    expect_furnace("furnished room", std::move(study), furniture);
  }
}

/// The checks that every run reports of itself, on the reference scenes.
void expect_balance(const std::string& name, double accuracy, double bound) {
  const auto path = write_validation_study(name, testing::TempDir() + "clerestory-balance", accuracy);
  const lighting::Results results = answer(io::read_study(path).study);
  std::printf("[ FIGURES  ] %s at %.0f %%: balance %+.1e, reciprocity %.1e, closure %.1e\n", name.c_str(),
              100.0 * accuracy, results.energy.residual, results.energy.reciprocity, results.energy.closure);
  EXPECT_LE(std::abs(results.energy.residual), bound) << name;
  EXPECT_LE(results.energy.closure, bound) << name;
  EXPECT_LE(results.energy.reciprocity, bound) << name;
}

TEST(EnergyBalance, ClosesInTheEmptyLampRoomToOneInTenThousandAtAnyAccuracy) {
  CLERESTORY_NEEDS_VALIDATION("lamp-room");
  for (const double accuracy : {0.08, 0.04, 0.02, 0.01}) expect_balance("lamp-room", accuracy, 1e-4);
}

TEST(EnergyBalance, ClosesInTheOfficeToAQuarterOfTheAccuracy) {
  CLERESTORY_NEEDS_VALIDATION("office");
  expect_balance("office", 0.02, 0.02 / 4);
}

}  // namespace
}  // namespace clerestory::test
