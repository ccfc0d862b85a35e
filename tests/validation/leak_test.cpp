// SPDX-License-Identifier: GPL-3.0-or-later
// Two rooms that share a floor slab, a ceiling and two walls, under and between which a thin wall stands; light in one only. The other must
// receive nothing at all, and no tolerance hides a leak.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "lighting/gather.h"
#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"
#include "tests/validation/slit_rooms.h"
#include "tests/validation/statistics.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

constexpr double kWall_m = 3.0;  ///< where the dividing wall stands, x
constexpr mesh::Vector kOblique{0.48, -0.6, 0.64};

struct Turn {
  double degrees;
  mesh::Vector axis;
  double thickness_m;
};
void PrintTo(const Turn& turn, std::ostream* out) {
  *out << turn.degrees << " degrees about " << turn.axis.x << " " << turn.axis.y << " " << turn.axis.z << ", wall of "
       << turn.thickness_m << " m";
}

class Leak : public testing::TestWithParam<Turn> {
 protected:
  [[nodiscard]] double angle() const { return GetParam().degrees * std::numbers::pi / 180.0; }
  [[nodiscard]] mesh::Point place(const mesh::Point& p) const { return turned(p, GetParam().axis, angle()); }
  [[nodiscard]] mesh::Point unplaced(const mesh::Point& p) const { return turned(p, GetParam().axis, -angle()); }

  /// A lamp under the ceiling and a point source, both in the room x < 3; sensors in the other.
  [[nodiscard]] lighting::Study study() const {
    mesh::Model model = support::two_rooms_with_thin_wall({.thickness_m = GetParam().thickness_m});
    support::add_quad(model, {1, 2.5, 2.6}, {2, 2.5, 2.6}, {2, 1.5, 2.6}, {1, 1.5, 2.6},
                      {.material = "lamp", .part = "lamp"});
    lighting::Study study = grey_study(support::rotated(std::move(model), GetParam().axis, angle()), 0.7);
    shine(material(study, "lamp"), 5000.0);
    study.luminaires.push_back(clerestory::test::isotropic_lamp(place({2.9, 2.1, 0.3}), 500.0));
    std::vector<mesh::Point> points;
    for (const double x : {kWall_m + 0.5 * GetParam().thickness_m + 0.002, 3.2, 4.5, 5.9})
      for (const double y : {0.003, 1.3, 2.0, 3.997})
        for (const double z : {0.001, 0.8, 2.999}) points.push_back(place({x, y, z}));
    for (const mesh::Vector& n : {mesh::Vector{0, 0, 1}, mesh::Vector{-1, 0, 0}, mesh::Vector{0, 0, -1}})
      add_sensors(study, points, turned(n, GetParam().axis, angle()));
    add_sensors(study, std::vector{place({1.5, 2.0, 0.5})}, turned(mesh::Vector{0, 0, 1}, GetParam().axis, angle()));
    return study;
  }

  /// Whether the space before a cell is the lit room (the cell's winding says which side it is).
  [[nodiscard]] bool looks_into_lit_room(const lighting::SurfaceResult& surfaces, std::size_t cell) const {
    const auto& c = surfaces.cells[cell];
    const mesh::Point& a = surfaces.points[c[0]];
    const mesh::Vector ab = surfaces.points[c[1]] - a;
    const mesh::Vector ac = surfaces.points[c[2]] - a;
    const mesh::Point before = unplaced(a + (ab + ac) / 3.0 + 1e-4 * normalized(cross(ab, ac)));
    return before.x > 0 && before.x < kWall_m && before.y > 0 && before.y < 4 && before.z > 0 && before.z < 3;
  }
};

TEST_P(Leak, DarkRoomReceivesExactlyNothing) {
  const lighting::Results results = answer(study());
  const auto& values = results.grids.at(0).illuminance_lux;
  ASSERT_GE(values.size(), 80U);  // in the corners of a room without light a sensor may be taken for one inside a solid
  for (std::size_t i = 0; i + 1 < values.size(); ++i) EXPECT_EQ(values[i], 0.0F) << "sensor " << i;
  EXPECT_GT(values.back(), 100.0F) << "the lit room is lit";

  double lit = 0.0;
  for (std::size_t cell = 0; cell < results.surfaces.cells.size(); ++cell) {
    if (looks_into_lit_room(results.surfaces, cell)) {
      lit += results.surfaces.illuminance_lux[cell];
    } else {
      EXPECT_EQ(results.surfaces.illuminance_lux[cell], 0.0F) << "cell " << cell;
      EXPECT_EQ(results.surfaces.radiosity_lm_m2[cell], 0.0F) << "cell " << cell;
    }
  }
  EXPECT_GT(lit, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Rotations, Leak,
                         testing::Values(Turn{0.0, {0, 0, 1}, 0.0}, Turn{17.3, {0, 0, 1}, 0.0},
                                         Turn{41.7, kOblique, 0.0}, Turn{0.0, {0, 0, 1}, 0.1},
                                         Turn{17.3, kOblique, 0.1}, Turn{41.7, {0, 0, 1}, 0.001}));

std::vector<support::ThinWall> short_walls(double short_m) {
  return {{.short_m = short_m},
          {.rotation_rad = 0.3, .short_m = short_m},
          {.thickness_m = 0.1, .rotation_rad = 0.73, .axis = kOblique, .short_m = short_m}};
}

TEST(ShortWall, OneMillimetreAboveTheFloorIsClosedAndNothingGetsThroughAtAnyAccuracy) {
  for (const support::ThinWall& wall : short_walls(0.001)) {
    for (const double accuracy : {0.08, 0.02, 0.01}) {
      lighting::Study study = rooms_with_short_wall(wall);
      add_sensors(study, std::vector{turned(mesh::Point{1.5, 2.0, 0.5}, wall.axis, wall.rotation_rad)},
                  turned(mesh::Vector{0, 0, 1}, wall.axis, wall.rotation_rad));
      study.mesh.discontinuities = false;
      study.accuracy.target = accuracy;
      const lighting::Results results = answer(study);
      const auto& values = results.grids.at(0).illuminance_lux;
      for (std::size_t i = 0; i + 1 < values.size(); ++i) EXPECT_EQ(values[i], 0.0F) << accuracy;
      EXPECT_GT(values.back(), 100.0F) << "the lit room is lit";
    }
  }
}

/// Illuminance at the sensors of a study, solved by its stages with no room known to any of them [lux].
std::vector<float> without_rooms(const lighting::Study& study) {
  lighting::test::Stage stage(study);
  stage.scene.rooms = {};
  const double target = study.accuracy.target;
  const std::uint64_t seed = study.accuracy.seed;
  NoProgress nobody;
  const lighting::Importance importance(stage.solution, stage.walks(seed));
  lighting::DirectLight direct = lighting::light_directly(stage.solution, importance, 0.002 * target, seed, nobody);
  const lighting::Transport transport =
      lighting::solve(stage.solution, importance, std::move(direct), {.accuracy = target, .seed = seed}, nobody);
  return lighting::gather(stage.solution, transport.errors, {stage.positions, stage.normals}, target, seed, nobody)
      .illuminance_lux;
}

/// How the wall between the rooms closes them off.
struct ClosedWall {
  const char* name;
  double thickness_m;
  double short_m;
  bool is_solid;  ///< a closed body, whose corners clean-up does not move
};
void PrintTo(const ClosedWall& wall, std::ostream* out) { *out << wall.name; }

constexpr std::size_t kLitSensor = 4;  ///< and the last one

class ClosedRooms : public testing::TestWithParam<ClosedWall> {
 protected:
  /// Sensors in the dark room, and one in the lit one.
  static lighting::Study study(double angle_rad) {
    const auto& [name, thickness_m, short_m, is_solid] = GetParam();
    mesh::Model model = is_solid ? support::box_room(6, 4, 3)
                                 : support::two_rooms_with_thin_wall({.thickness_m = thickness_m, .short_m = short_m});
    if (is_solid) {
      const double half = 0.5 * thickness_m;
      support::add_box(model, {kWall_m - half, 0, short_m}, {kWall_m + half, 4, 3}, {"partition", "partition"});
    }
    support::add_quad(model, {1, 2.5, 2.6}, {2, 2.5, 2.6}, {2, 1.5, 2.6}, {1, 1.5, 2.6}, {"lamp", "lamp"});
    lighting::Study study = grey_study(support::rotated(std::move(model), kOblique, angle_rad), 0.7);
    shine(material(study, "lamp"), 5000.0);
    std::vector<mesh::Point> points;
    for (const mesh::Point& p : {mesh::Point{3.07, 2.0, 0.01}, mesh::Point{3.1, 0.1, 0.3}, mesh::Point{4.5, 2.0, 0.8},
                                 mesh::Point{5.9, 3.9, 2.9}, mesh::Point{1.5, 2.0, 0.5}})
      points.push_back(turned(p, kOblique, angle_rad));
    for (const mesh::Vector& n : {mesh::Vector{-1, 0, 0}, mesh::Vector{0, 0, 1}})
      add_sensors(study, points, turned(n, kOblique, angle_rad));
    return study;
  }
};

TEST_P(ClosedRooms, TheDarkOneReceivesExactlyNothingThoughNoRoomIsKnown) {
  for (const double degrees : {0.0, 41.7}) {
    for (const double accuracy : {0.08, 0.02, 0.01}) {
      SCOPED_TRACE(testing::Message() << degrees << " degrees, accuracy " << accuracy);
      lighting::Study asked = study(degrees * std::numbers::pi / 180.0);
      asked.accuracy.target = accuracy;
      const std::vector<float> lux = without_rooms(asked);
      for (std::size_t i = 0; i + 1 < lux.size(); ++i) {
        if (i != kLitSensor) {
          EXPECT_EQ(lux[i], 0.0F) << "sensor " << i;
        }
      }
      EXPECT_GT(lux.back(), 100.0F) << "the lit room is lit";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Walls, ClosedRooms,
                         testing::Values(ClosedWall{"CommonSlab", 0.0, 0.0, false},
                                         ClosedWall{"TwoSheets", 0.1, 0.0, false}, ClosedWall{"Solid", 0.1, 0.0, true},
                                         ClosedWall{"SheetOneMillimetreShort", 0.0, 1e-3, false},
                                         ClosedWall{"TwoSheetsOneMillimetreShort", 0.1, 1e-3, false},
                                         ClosedWall{"SolidOneMillimetreShort", 0.1, 1e-3, true}),
                         [](const auto& wall) { return std::string(wall.param.name); });

TEST(ShortWall, FiveCentimetresAboveTheFloorLetThroughWhatPathTracingSays) {
  std::vector<double> reference;
  std::vector<double> reference_errors;
  for (const Traced& sensor : kSlitReference) {
    reference.push_back(sensor.illuminance_lux);
    reference_errors.push_back(sensor.standard_error_lux);
  }
  for (const double degrees : {0.0, 41.7}) {
    for (const double accuracy : {0.08, 0.02, 0.01}) {
      SCOPED_TRACE(testing::Message() << degrees << " degrees, accuracy " << accuracy);
      lighting::Study study = rooms_with_short_wall(
          {.rotation_rad = degrees * std::numbers::pi / 180.0, .axis = kOblique, .short_m = kSlit_m});
      study.mesh.discontinuities = false;
      study.accuracy.target = accuracy;
      const lighting::GridResult grid = answer(study).grids.at(0);
      const std::vector<double> values(grid.illuminance_lux.begin(), grid.illuminance_lux.end());
      const std::vector<double> errors(grid.error_lux.begin(), grid.error_lux.end());
      const Comparison found = compare(values, errors, reference, reference_errors);
      EXPECT_TRUE(grid.metrics.accuracy_met);
      EXPECT_LE(std::abs(found.bias), accuracy);
      EXPECT_LE(found.rms, accuracy);
      print(fmt::format("slit at {} %, turned by {} degrees", 100.0 * accuracy, degrees), found);
    }
  }
}

}  // namespace
}  // namespace clerestory::test
