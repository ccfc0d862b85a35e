// SPDX-License-Identifier: GPL-3.0-or-later
// Two rooms that share a floor slab, a ceiling and two walls, under and between which a thin wall stands; light in one only. The other must
// receive nothing at all, and no tolerance hides a leak.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <ostream>
#include <utility>
#include <vector>

#include "tests/support/lamps.h"
#include "tests/support/shapes.h"
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

/// A vector turned about a unit axis, right-handed [Rodrigues 1840].
mesh::Vector turned(const mesh::Vector& v, const mesh::Vector& axis, double angle_rad) {
  const double c = std::cos(angle_rad);
  return c * v + std::sin(angle_rad) * cross(axis, v) + ((1.0 - c) * dot(axis, v)) * axis;
}
mesh::Point turned(const mesh::Point& p, const mesh::Vector& axis, double angle_rad) {
  return mesh::Point{} + turned(p - mesh::Point{}, axis, angle_rad);
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

/// The two rooms, a lamp in the one, sensors in the other, and a wall between them that ends above the floor.
lighting::Study rooms_with_short_wall(const support::ThinWall& wall) {
  mesh::Model model =
      support::two_rooms_with_thin_wall({.thickness_m = wall.thickness_m, .axis = wall.axis, .short_m = wall.short_m});
  support::add_quad(model, {1, 2.5, 2.6}, {2, 2.5, 2.6}, {2, 1.5, 2.6}, {1, 1.5, 2.6},
                    {.material = "lamp", .part = "lamp"});
  lighting::Study study = grey_study(support::rotated(std::move(model), wall.axis, wall.rotation_rad), 0.7);
  shine(material(study, "lamp"), 5000.0);
  std::vector<mesh::Point> points;
  for (const double x : {3.4, 4.5, 5.6})
    for (const double y : {0.5, 2.0, 3.5})
      for (const double z : {0.3, 1.5}) points.push_back(turned(mesh::Point{x, y, z}, wall.axis, wall.rotation_rad));
  add_sensors(study, points, turned(mesh::Vector{0, 0, 1}, wall.axis, wall.rotation_rad));
  return study;
}

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

TEST(ShortWall, FiveCentimetresAboveTheFloorLetThroughWhatPathTracingSays) {
  // The mean of the sensors by 3 000 000 paths each that also aim at the slit and at the floor behind it, weighed by the balance
  // heuristic [Veach 1997]; its standard error is 0.0022 lx. The plain tracer of these tests has found the same within its 2.4 %.
  constexpr double kMean = 1.0716;
  struct Case {
    double degrees;
    double accuracy;
  };
  for (const auto& [degrees, accuracy] : {Case{0.0, 0.02}, Case{41.7, 0.08}}) {
    lighting::Study study =
        rooms_with_short_wall({.rotation_rad = degrees * std::numbers::pi / 180.0, .axis = kOblique, .short_m = 0.05});
    study.mesh.discontinuities = false;
    study.accuracy.target = accuracy;
    const lighting::Results results = answer(study);
    const auto& lux = results.grids.at(0).illuminance_lux;
    const double mean = std::accumulate(lux.begin(), lux.end(), 0.0) / static_cast<double>(lux.size());
    EXPECT_NEAR(mean, kMean, accuracy * kMean) << degrees << " degrees";
  }
}

}  // namespace
}  // namespace clerestory::test
