// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/lit_limit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "lighting/lit_mesh.h"
#include "lighting/shown_mesh.h"
#include "lighting/surface_values.h"
#include "mesh/subdivision.h"
#include "tests/lighting/stages.h"
#include "tests/support/cages.h"
#include "tests/support/lamps.h"
#include "tests/support/shapes.h"

// Points of curved parts are lit with the normal of their limit surface.
namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

constexpr std::uint64_t kSeed = 12345;
constexpr double kAccuracy = 0.02;
constexpr Point kMiddle{2, 2, 1.5};

/// A ball of limit surface, some 0.7 m across, in the middle of a room.
Study ball_in_a_room(double reflectance, double chord_tolerance_m) {
  mesh::Model ball = support::cube_cage();
  for (Point& p : ball.vertices) p = kMiddle + 0.5 * (p - Point{});
  mesh::Model room = support::box_room(4, 4, 3);
  support::append(room, ball);
  std::vector<std::optional<mesh::CurvedPart>> parts(room.part_names.size());
  parts.back() = mesh::CurvedPart{mesh::SubdivisionScheme::kCatmullClark, chord_tolerance_m};
  return test::study_of(mesh::subdivide(room, parts), reflectance, Point{0.1, 0.1, 0.1});
}

/// What a run shows of a study.
SurfaceResult shown_surfaces(const Study& study) {
  test::Stage stage(study);
  NoProgress nobody;
  const Importance importance(stage.solution, stage.walks(kSeed));
  DirectLight direct = light_directly(stage.solution, importance, 0.002 * kAccuracy, kSeed, nobody);
  const Transport transport = solve(stage.solution, importance, direct, {.accuracy = kAccuracy, .seed = kSeed}, nobody);
  const LocalPass local(stage.solution, transport.arrivals, transport.errors, direct.nodes, kAccuracy,
                        0.05 * importance.mean_lux());
  const ShownMesh shown =
      shown_mesh(stage.solution, transport.errors, local, {kAccuracy, 0.05 * importance.mean_lux(), 100000}, nobody);
  const LitMesh lit = light_mesh(stage.solution, shown, local, nobody);
  return surface_values(stage.solution, transport.errors, shown, lit, local, nobody);
}

/// Points of the ball's outside or inside.
std::vector<std::uint32_t> points_of_ball(const SurfaceResult& s, mesh::Side side) {
  std::vector<std::uint32_t> points;
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    if (s.part_names[static_cast<std::size_t>(s.part[i])] != "cage") continue;
    if (s.side[i] == static_cast<std::uint8_t>(side)) points.insert(points.end(), s.cells[i].begin(), s.cells[i].end());
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// Points by their places.
class Places {
 public:
  explicit Places(const SurfaceResult& s) : points_(s.points) {
    for (std::uint32_t p = 0; p < s.points.size(); ++p) at_[{s.points[p].x, s.points[p].y, s.points[p].z}] = p;
  }

  /// The point that hangs on the middle of an edge.
  [[nodiscard]] std::optional<std::uint32_t> between(std::uint32_t a, std::uint32_t b) const {
    const Point middle = midpoint(points_[a], points_[b]);
    const auto found = at_.find({middle.x, middle.y, middle.z});
    return found == at_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  const std::vector<Point>& points_;
  std::map<std::array<double, 3>, std::uint32_t> at_;
};

/// All points that hang on edges of larger cells: light there is that of the edge.
std::set<std::uint32_t> hanging_points(const SurfaceResult& s) {
  const Places places(s);
  std::set<std::uint32_t> hanging;
  for (const auto& cell : s.cells) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (const auto point = places.between(cell[k], cell[(k + 1) % 3])) hanging.insert(*point);
    }
  }
  return hanging;
}

/// Of a source of 1000 cd, without occluders, on the limit surface [lux]; and the cosine there.
std::pair<double, double> exact_at(const SurfaceResult& s, std::uint32_t point, const Point& source) {
  const Vector to = source - s.points[point];
  const double cosine = dot(to, s.point_normals[point]) / norm(to);
  return {1000.0 * std::max(0.0, cosine) / dot(to, to), cosine};
}

TEST(LitLimit, LightFromAPointSourceFallsOnTheOutsideByTheLimitsNormal) {
  Study study = ball_in_a_room(0.0, 0.02);
  const Point source{1.2, 2.3, 2.8};
  study.luminaires.push_back(clerestory::test::isotropic_lamp(source, 1000.0));
  const SurfaceResult s = shown_surfaces(study);
  std::size_t lit = 0;
  const std::set<std::uint32_t> hanging = hanging_points(s);
  for (const std::uint32_t p : points_of_ball(s, mesh::Side::kFront)) {
    if (hanging.contains(p)) continue;
    const auto [exact, cosine] = exact_at(s, p, source);
    // Where light grazes, triangles stand in its way.
    if (std::abs(cosine) < 0.2) continue;
    EXPECT_NEAR(s.point_illuminance_lux[p], exact, 5.0) << "of 900 at most, cosine " << cosine;
    lit += exact > 100.0 ? 1 : 0;
  }
  EXPECT_GT(lit, 20U);
}

// Seen from inside, triangles stand before the limit surface, and rays start on them: so much nearer to the source at most.
TEST(LitLimit, LightFromAPointSourceFallsOnTheInsideByTheLimitsNormal) {
  constexpr double kChordM = 0.002;
  Study study = ball_in_a_room(0.0, kChordM);
  const Point source{1.9, 2.1, 1.6};
  study.luminaires.push_back(clerestory::test::isotropic_lamp(source, 1000.0));
  const SurfaceResult s = shown_surfaces(study);
  const auto inside = points_of_ball(s, mesh::Side::kBack);
  EXPECT_GT(inside.size(), 40U);
  const std::set<std::uint32_t> hanging = hanging_points(s);
  for (const std::uint32_t p : inside) {
    if (hanging.contains(p)) continue;
    const auto [exact, cosine] = exact_at(s, p, source);
    const double nearer = 2.0 * kChordM / norm(source - s.points[p]);
    EXPECT_NEAR(s.point_illuminance_lux[p], exact, (nearer + 0.001) * exact);
  }
}

TEST(LitLimit, AnEvenFurnaceShowsNoFacets) {
  Study study = ball_in_a_room(0.5, 0.02);
  for (Material& m : study.materials) test::shine(m, 20.0);
  const SurfaceResult s = shown_surfaces(study);
  for (const std::uint32_t p : points_of_ball(s, mesh::Side::kFront))
    EXPECT_NEAR(s.point_illuminance_lux[p], 40.0, kAccuracy * 40.0);
}

/// Edges of the cells of the ball's outside, cut where points hang on their middles: what no neighbour walks the other way.
std::size_t open_edges(const SurfaceResult& s) {
  const Places places(s);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> walked;
  const std::function<void(std::uint32_t, std::uint32_t)> walk = [&](std::uint32_t a, std::uint32_t b) {
    if (const auto hanging = places.between(a, b)) {
      walk(a, *hanging);
      walk(*hanging, b);
    } else {
      walked[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  };
  for (std::size_t i = 0; i < s.cells.size(); ++i) {
    if (s.part_names[static_cast<std::size_t>(s.part[i])] != "cage" || s.side[i] != 0) continue;
    for (std::size_t k = 0; k < 3; ++k) walk(s.cells[i][k], s.cells[i][(k + 1) % 3]);
  }
  return static_cast<std::size_t>(
      std::count_if(walked.begin(), walked.end(), [](const auto& edge) { return edge.second != 0; }));
}

TEST(LitLimit, ThereAreNoCracksBetweenSmallAndLargeCells) {
  Study study = ball_in_a_room(0.5, 0.02);
  study.luminaires.push_back(clerestory::test::isotropic_lamp({2.7, 2.0, 2.3}, 1000.0));
  const SurfaceResult s = shown_surfaces(study);
  EXPECT_GT(hanging_points(s).size(), 10U);
  EXPECT_EQ(open_edges(s), 0U);
}

}  // namespace
}  // namespace clerestory::lighting
