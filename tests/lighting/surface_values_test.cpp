// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/surface_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include "mesh/subdivision.h"
#include "tests/lighting/stages.h"
#include "tests/support/cages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;
using testing::Each;
using testing::Gt;
using testing::Lt;

constexpr Vector kShift{1000.0, 2000.0, 50.0};

Study furnace() {
  Study study = test::study_of(support::moved(support::box_room(4, 5, 3), kShift), 0.5, Point{2, 2, 1} + kShift);
  for (Material& m : study.materials) test::shine(m, 20.0);
  return study;
}

Vector area_vector(const SurfaceResult& s, std::size_t cell) {
  const auto& c = s.cells[cell];
  return 0.5 * cross(s.points[c[1]] - s.points[c[0]], s.points[c[2]] - s.points[c[0]]);
}

TEST(SurfaceValues, CellsCoverBothSidesAndArraysAreParallel) {
  const test::Solved solved(furnace());
  const SurfaceResult s = surface_values(solved.solution, solved.transport.errors);
  const std::size_t n = s.cells.size();
  double area[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < n; ++i) area[s.side[i]] += norm(area_vector(s, i));
  EXPECT_NEAR(area[0], 94.0, 1e-6);
  EXPECT_NEAR(area[1], 94.0, 1e-6);
  for (const std::size_t size :
       {s.side.size(), s.illuminance_lux.size(), s.error_lux.size(), s.radiosity_lm_m2.size(), s.luminance_cd_m2.size(),
        s.reflectance.size(), s.level.size(), s.part.size(), s.material.size(), s.room.size()}) {
    EXPECT_EQ(size, n);
  }
  EXPECT_EQ(s.points.size(), s.point_illuminance_lux.size());
}

TEST(SurfaceValues, PointsStandInModelCoordinates) {
  const test::Solved solved(furnace());
  mesh::Box box;
  for (const Point& p : surface_values(solved.solution, solved.transport.errors).points) box.add(p);
  EXPECT_NEAR(norm(box.low - (Point{} + kShift)), 0.0, 1e-6);
  EXPECT_NEAR(norm(box.high - (Point{4, 5, 3} + kShift)), 0.0, 1e-6);
}

TEST(SurfaceValues, FrontsLookIntoTheRoomAndBacksOut) {
  const test::Solved solved(furnace());
  const SurfaceResult s = surface_values(solved.solution, solved.transport.errors);
  const Point middle = Point{2, 2.5, 1.5} + kShift;
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    const double inwards = dot(middle - s.points[s.cells[i][0]], area_vector(s, i));
    EXPECT_EQ(inwards > 0.0, s.side[i] == 0);
  }
}

TEST(SurfaceValues, OfTheFurnaceAreItsOwnWithinTheAccuracy) {
  const test::Solved solved(furnace());
  const SurfaceResult s = surface_values(solved.solution, solved.transport.errors);
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    const bool front = s.side[i] == 0;
    EXPECT_NEAR(s.illuminance_lux[i], front ? 40.0 : 0.0, 0.8);
    EXPECT_NEAR(s.radiosity_lm_m2[i], front ? 40.0 : 0.0, 0.8);
    EXPECT_NEAR(s.luminance_cd_m2[i], s.radiosity_lm_m2[i] / std::numbers::pi, 1e-4);
    EXPECT_FLOAT_EQ(s.reflectance[i], 0.5F);
    EXPECT_EQ(s.room[i], front ? 0 : -1);
    for (const std::uint32_t p : s.cells[i]) EXPECT_NEAR(s.point_illuminance_lux[p], front ? 40.0 : 0.0, 0.8);
  }
}

TEST(SurfaceValues, NamesBelongToTheCells) {
  const test::Solved solved(furnace());
  const SurfaceResult s = surface_values(solved.solution, solved.transport.errors);
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    const std::string& name = s.material_names.at(static_cast<std::size_t>(s.material[i]));
    const double vertical = std::abs(normalized(area_vector(s, i)).z);
    EXPECT_EQ(name == "wall", vertical < 0.5);
    EXPECT_EQ(s.part_names.at(static_cast<std::size_t>(s.part[i])), "room");
  }
}

TEST(SurfaceValues, PointsAreSharedWithinAFaceAndNeverAcrossItsEdgesOrSides) {
  const test::Solved solved(furnace());
  const SurfaceResult s = surface_values(solved.solution, solved.transport.errors);
  std::vector<std::set<std::pair<int, std::array<int, 3>>>> users(s.points.size());
  std::size_t shared = 0;
  std::vector<int> count(s.points.size(), 0);
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    const Vector n = normalized(area_vector(s, i));
    const std::array<int, 3> axis{static_cast<int>(std::lround(n.x)), static_cast<int>(std::lround(n.y)),
                                  static_cast<int>(std::lround(n.z))};
    for (const std::uint32_t p : s.cells[i]) {
      users[p].insert({s.side[i], axis});
      shared += count[p]++ > 0 ? 1 : 0;
    }
  }
  for (const auto& of_point : users) EXPECT_EQ(of_point.size(), 1U);
  EXPECT_GT(shared, 0U);
}

/// What the points of the floor's front on a line x = ... have, as cells to its left (lit) and to its right (dark) use them.
struct Parted {
  std::vector<float> lit_lux;
  std::vector<float> dark_lux;
};

Parted parted(const SurfaceResult& s, double x, double up_to_y = std::numeric_limits<double>::infinity()) {
  Parted found;
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    if (s.material_names.at(static_cast<std::size_t>(s.material[i])) != "floor" || s.side[i] != 0) continue;
    Vector middle;
    for (const std::uint32_t p : s.cells[i]) middle = middle + (s.points[p] - Point{}) / 3.0;
    for (const std::uint32_t p : s.cells[i]) {
      if (std::abs(s.points[p].x - x) > 1e-6 || s.points[p].y > up_to_y) continue;
      (middle.x < x ? found.lit_lux : found.dark_lux).push_back(s.point_illuminance_lux[p]);
    }
  }
  return found;
}

TEST(SurfaceValues, LightDoesNotCrossAContact) {
  // A wall stands on one floor; only the room x < 3 is lit. Points along its foot are either lit or dark.
  Study study = test::study_of(support::two_rooms_with_thin_wall(), 0.5, {1.5, 2, 1});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({1.5, 2, 2.5}, 1000.0));
  const test::Solved solved(study);
  const SurfaceResult s = surface_values(solved.solution, solved.transport.errors);
  const Parted foot = parted(s, 3.0);
  EXPECT_THAT(foot.lit_lux, Each(Gt(10.0F)));
  EXPECT_THAT(foot.dark_lux, Each(0.0F));
  EXPECT_FALSE(foot.lit_lux.empty());
  EXPECT_FALSE(foot.dark_lux.empty());
}

TEST(SurfaceValues, LightDoesNotCrossTheFootOfAScreenWithAFreeEnd) {
  // The screen x = 2 leaves the floor connected round its end at y = 3; the source shines from the side x < 2.
  mesh::Model model = support::box_room(4, 4, 3);
  support::add_quad(model, {2, 0, 0}, {2, 3, 0}, {2, 3, 2}, {2, 0, 2}, {"screen", "screen"});
  Study study = test::study_of(std::move(model), 0.0, {1, 2, 1});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({1, 2, 1}, 1000.0));
  const test::Solved solved(study);
  const SurfaceResult s = surface_values(solved.solution, solved.transport.errors);
  const Parted foot = parted(s, 2.0, 2.5);
  EXPECT_THAT(foot.lit_lux, Each(Gt(50.0F)));
  EXPECT_THAT(foot.dark_lux, Each(Lt(10.0F)));
  EXPECT_FALSE(foot.lit_lux.empty());
  EXPECT_FALSE(foot.dark_lux.empty());
}

TEST(SurfaceValues, HangingPointsHaveWhatTheEdgesOfLargerCellsHave) {
  Study study = test::study_of(support::box_room(4, 4, 3), 0.3, {1, 2, 1});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({1, 2, 0.6}, 1000.0));
  const test::Solved solved(study);
  const SurfaceResult s = surface_values(solved.solution, solved.transport.errors);
  int hanging = 0;
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = s.cells[i][k];
      const std::uint32_t b = s.cells[i][(k + 1) % 3];
      const Vector along = s.points[b] - s.points[a];
      for (std::size_t j = 0; j < s.points.size(); ++j) {
        const Vector to = s.points[j] - s.points[a];
        const double t = dot(to, along) / dot(along, along);
        if (t < 1e-6 || t > 1.0 - 1e-6 || norm(to - t * along) > 1e-6) continue;
        if (dot(s.point_normals[j], s.point_normals[a]) < 0.9) continue;
        ++hanging;
        const double edge = (1.0 - t) * s.point_illuminance_lux[a] + t * s.point_illuminance_lux[b];
        EXPECT_NEAR(s.point_illuminance_lux[j], edge, 1e-5 * edge);
      }
    }
  }
  EXPECT_GT(hanging, 10);
}

/// A ball of limit surface, some 1 m across, in the middle of a room that shines evenly.
Study ball_in_a_furnace() {
  mesh::Model model = support::cube_cage();
  for (Point& p : model.vertices) p = Point{2, 2, 1.5} + 0.5 * (p - Point{});
  mesh::Model room = support::box_room(4, 4, 3);
  support::append(room, model);
  std::vector<std::optional<mesh::CurvedPart>> parts(room.part_names.size());
  parts.back() = mesh::CurvedPart{mesh::SubdivisionScheme::kCatmullClark, 0.005};
  Study study = test::study_of(mesh::subdivide(room, parts), 0.5, Point{0.1, 0.1, 0.1});
  for (Material& m : study.materials) test::shine(m, 20.0);
  return study;
}

TEST(SurfaceValues, PointsOfACurvedPartLieOnItsLimitSurfaceAndAreSharedBetweenItsFacets) {
  const test::Solved solved(ball_in_a_furnace());
  const SurfaceResult s = surface_values(solved.solution, solved.transport.errors);
  ASSERT_EQ(s.point_normals.size(), s.points.size());
  std::set<std::uint32_t> points;
  std::size_t cells = 0;
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    if (s.part_names[static_cast<std::size_t>(s.part[i])] != "cage") continue;
    ++cells;
    points.insert(s.cells[i].begin(), s.cells[i].end());
    const Vector own = mesh::normalized(area_vector(s, i));
    for (const std::uint32_t p : s.cells[i]) EXPECT_GT(dot(own, s.point_normals[p]), 0.9);
  }
  // A closed surface of triangles has half as many points as triangles, and 2 more; hanging points come on top.
  ASSERT_GT(cells, 50U);
  EXPECT_LT(points.size(), 0.75 * static_cast<double>(cells));
  for (const std::uint32_t p : points) {
    EXPECT_NEAR(norm(s.point_normals[p]), 1.0, 1e-9);
    // The limit surface of a cube is round but for a few per cent.
    const Vector outward = s.points[p] - Point{2, 2, 1.5};
    EXPECT_GT(dot(mesh::normalized(outward), s.point_normals[p]), 0.95);
  }
}

TEST(SurfaceValues, FacetsDoNotShowInTheIlluminanceOfACurvedPart) {
  // All that an even furnace shows on any surface is the same; what differs is the solver's error, and no facet.
  const test::Solved solved(ball_in_a_furnace());
  const SurfaceResult s = surface_values(solved.solution, solved.transport.errors);
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    if (s.part_names[static_cast<std::size_t>(s.part[i])] != "cage" || s.side[i] != 0) continue;
    for (const std::uint32_t p : s.cells[i]) EXPECT_NEAR(s.point_illuminance_lux[p], 40.0, 2.0);
  }
}

}  // namespace
}  // namespace clerestory::lighting
