// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/local_pass.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lighting/emitters.h"
#include "lighting/form_factor.h"
#include "lighting/lit_mesh.h"
#include "lighting/shown_mesh.h"
#include "lighting/surface_values.h"
#include "tests/lighting/stages.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using mesh::Point;
using mesh::Vector;

constexpr double kLampLmM2 = 5000.0;
constexpr std::uint64_t kSeed = 12345;

/// Far more rays than a run takes.
constexpr double kExact = 0.001;

/// A solved study and its local pass.
struct Lit : test::Stage {
  explicit Lit(const Study& study, double accuracy = kExact)
      : Stage(study),
        importance(solution, walks(kSeed)),
        direct(light_directly(solution, importance, 0.002 * study.accuracy.target, kSeed, nobody)),
        transport(solve(solution, importance, direct, {.accuracy = study.accuracy.target, .seed = kSeed}, nobody)),
        local_pass(solution, transport.arrivals, transport.errors, direct.nodes, accuracy,
                   0.05 * importance.mean_lux()) {}

  /// The element of the floor's front at a point in local coordinates.
  [[nodiscard]] mesh::ElementId on_floor(const Point& p) const {
    return solution.element_at(solution.tree().face_side(root("floor")), 0, p);
  }
  /// Light on the floor's front.
  [[nodiscard]] LocalPass::Light light(const Point& model_point) const {
    const Point p = local(model_point);
    return local_pass.at(on_floor(p), p, local_pass.lamps_of(on_floor(p)));
  }
  [[nodiscard]] double at(const Point& model_point) const { return light(model_point).lux.at(0); }
  [[nodiscard]] ShownMesh shown(std::size_t most_elements) const {
    NoProgress unwatched;
    return shown_mesh(solution, transport.errors, local_pass, {0.02, 0.05 * importance.mean_lux(), most_elements},
                      unwatched);
  }

  NoProgress nobody;
  Importance importance;
  DirectLight direct;
  Transport transport;
  LocalPass local_pass;
};

/// A room with a lamp of 1 m × 0.5 m at 2.9 m that shines down, and a shelf at 2.2 m whose edge y = 2 runs along the lamp.
Study lamp_over_shelf(double reflectance = 0.5) {
  mesh::Model model = support::box_room(6, 4, 3);
  support::add_quad(model, {1.5, 1.5, 2.9}, {1.5, 2.0, 2.9}, {2.5, 2.0, 2.9}, {2.5, 1.5, 2.9}, {"lamp", "lamp"});
  support::add_quad(model, {0.5, 2, 2.2}, {3.5, 2, 2.2}, {3.5, 3.5, 2.2}, {0.5, 3.5, 2.2}, {"shelf", "shelf"});
  Study study = test::study_of(std::move(model), reflectance, {3, 2, 1});
  test::shine(test::material(study, "lamp"), kLampLmM2);
  return study;
}

/// Of the part of the lamp up to some y, on the floor, without occluders [lux].
double by_lamp(const Point& at, double from_y, double to_y) {
  const std::array<Point, 4> c{Point{1.5, from_y, 2.9}, Point{1.5, to_y, 2.9}, Point{2.5, to_y, 2.9},
                               Point{2.5, from_y, 2.9}};
  std::vector<mesh::OutlineEdge> edges;
  for (std::size_t k = 0; k < 4; ++k) edges.push_back({c[k], c[(k + 1) % 4]});
  return kLampLmM2 * point_form_factor(at, {0, 0, 1}, edges, {0, 0, -1});
}

TEST(LocalPass, OfALampIsExactInLightAndUmbraAndByItsVisiblePartInThePenumbra) {
  const Lit lit(lamp_over_shelf(0.0));
  const Point clear{2, 1, 0};
  EXPECT_NEAR(lit.at(clear), by_lamp(clear, 1.5, 2.0), 1e-4 * by_lamp(clear, 1.5, 2.0));
  // The plane through the edge y = 2, z = 2.2 and the lamp's middle y = 1.75 meets the floor at y = 2 + 2.2 · 0.25 / 0.7.
  const Point half{2, 2.0 + 2.2 * 0.25 / 0.7, 0};
  EXPECT_NEAR(lit.at(half), by_lamp(half, 1.5, 1.75), 1e-4 * by_lamp(half, 1.5, 1.75));
  EXPECT_EQ(lit.at({2, 2.0 + 2.2 * 0.55 / 0.7, 0}), 0.0);
}

/// A globe of facets over a plate of 1 m × 2 m, in black.
Study globe_over_plate(int meridians, int parallels) {
  mesh::Model model = support::box_room(6, 4, 3);
  support::add_globe(model, {2, 2, 2.5}, 0.15, meridians, parallels, {"lamp", "globe"});
  support::add_quad(model, {2.2, 1, 1.5}, {3.2, 1, 1.5}, {3.2, 3, 1.5}, {2.2, 3, 1.5}, {"plate", "plate"});
  Study study = test::study_of(std::move(model), 0.0, {1, 2, 1});
  test::shine(test::material(study, "lamp"), kLampLmM2);
  return study;
}

/// What clipping all facets of a globe gives at a point, and what they would give if nothing stood before them [lux].
struct GlobeLight {
  GlobeLight(const Lit& lit, std::span<const Emitter> facets, const Point& p) {
    const Vector up{0, 0, 1};
    const Point from = lit.local(p) + lit.scene.rays->offset_m() * up;
    for (const Emitter& facet : facets) {
      const double factor = full_factor(lit.solution, facet, from, up);
      full += kLampLmM2 * factor;
      clipped += kLampLmM2 * seen_factor(lit.solution, facet, factor, from, up).factor;
    }
  }
  /// At its horizon facets hide a little of each other.
  [[nodiscard]] bool is_partly_hidden() const { return clipped > 1e-3 * full && clipped < (1.0 - 1e-3) * full; }

  double full = 0.0;
  double clipped = 0.0;
};

/// Expects that a globe's light is what clipping gives, along a line from light to umbra and back to light.
void expect_clipped_light(int meridians, int parallels, double step) {
  const Lit lit(globe_over_plate(meridians, parallels), 0.02);
  const std::vector<Emitter> facets = emitters(lit.solution);
  ASSERT_GT(facets.size(), 0.9 * meridians * parallels) << "at the poles some lie in one plane";
  int penumbra = 0;
  int umbra = 0;
  for (double x = 0.25; x < 6.0; x += step) {
    const Point p{x, 1.9, 0};
    const GlobeLight globe(lit, facets, p);
    const bool partly = globe.is_partly_hidden();
    penumbra += partly ? 1 : 0;
    umbra += globe.clipped <= 1e-3 * globe.full ? 1 : 0;
    const LocalPass::Light light = lit.light(p);
    // Of some 250 facets those at the edge of the shadow are in or out.
    EXPECT_NEAR(light.lux.at(0), globe.clipped, (partly ? 0.02 : 1e-3) * globe.full) << x;
    EXPECT_EQ(light.error_lux > 1e-3 * globe.full, partly) << x;
    const mesh::ElementId element = lit.on_floor(lit.local(p));
    EXPECT_NEAR(lit.local_pass.by_lamps(element, lit.local(p), lit.local_pass.lamps_of(element), 0.0).value(),
                light.lux.at(0), 1e-9);
  }
  EXPECT_GT(penumbra, 3);
  EXPECT_GT(umbra, 1);
}

TEST(LocalPass, OfAGlobeIsThatOfItsFacetsInLightPenumbraAndUmbra) { expect_clipped_light(32, 16, 0.125); }

TEST(LocalPass, OfAGlobeOfThousandsOfFacetsSomeStandForAll) { expect_clipped_light(64, 48, 0.2); }

TEST(LocalPass, IsAboutWhatWasSolvedOnTheMean) {
  const Lit lit(lamp_over_shelf(), 0.02);
  double anew = 0.0;
  double solved = 0.0;
  for (double x = 0.1; x < 6.0; x += 0.2) {
    for (double y = 0.1; y < 4.0; y += 0.2) {
      const Point p = lit.local({x, y, 0});
      anew += lit.at({x, y, 0});
      solved += lit.solution.illuminance_at(lit.on_floor(p), p);
    }
  }
  EXPECT_NEAR(solved / anew, 1.0, 0.03);
}

TEST(LocalPass, StatesTheErrorThatItHas) {
  const Lit lit(lamp_over_shelf(), 0.02);
  const Lit exact(lamp_over_shelf());
  double square = 0.0;
  std::size_t count = 0;
  for (double x = 0.3; x < 6.0; x += 0.3) {
    for (double y = 0.3; y < 4.0; y += 0.3) {
      const LocalPass::Light light = lit.light({x, y, 0});
      const double z = (light.lux.at(0) - exact.at({x, y, 0})) / light.error_lux;
      square += z * z;
      ++count;
    }
  }
  const double rms = std::sqrt(square / static_cast<double>(count));
  EXPECT_GT(rms, 0.3);
  EXPECT_LT(rms, 1.2);
}

/// A floor under a lid with a hole of 2 m × 2 m, filled by a sheet of that name; walls all round.
mesh::Model room_with_hole(const char* filled_by) {
  mesh::Model room;
  for (const auto& [a, b, c, d, name] : std::vector<std::tuple<Point, Point, Point, Point, const char*>>{
           {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, "floor"},
           {{0, 0, 0}, {0, 0, 3}, {4, 0, 3}, {4, 0, 0}, "wall"},
           {{4, 0, 0}, {4, 0, 3}, {4, 4, 3}, {4, 4, 0}, "wall"},
           {{4, 4, 0}, {4, 4, 3}, {0, 4, 3}, {0, 4, 0}, "wall"},
           {{0, 4, 0}, {0, 4, 3}, {0, 0, 3}, {0, 0, 0}, "wall"}}) {
    support::add_quad(room, a, b, c, d, {name, name});
  }
  support::add_quad(room, {1, 1, 3}, {1, 3, 3}, {3, 3, 3}, {3, 1, 3}, {filled_by, filled_by});
  support::add_polygon(room, {{0, 0, 3}, {0, 4, 3}, {4, 4, 3}, {4, 0, 3}}, {"lid", "lid"},
                       {{{1, 1, 3}, {3, 1, 3}, {3, 3, 3}, {1, 3, 3}}});
  return room;
}

/// A room with a lamp in its lid.
Study lamp_in_lid(double accuracy) {
  Study study = test::study_of(room_with_hole("lamp"), 0.5, {2, 2, 0.8});
  test::shine(test::material(study, "lamp"), kLampLmM2);
  study.accuracy.target = accuracy;
  return study;
}

TEST(LocalPass, ByLinksFollowsTheLightToTheFeetOfWalls) {
  const Lit coarse(lamp_in_lid(0.02), 0.02);
  const Lit fine(lamp_in_lid(0.002), 0.002);
  double square = 0.0;
  double square_solved = 0.0;
  double count = 0.0;
  for (double x = 0.04; x < 4.0; x += 0.12) {
    const Point at{x, 0.02, 0};
    const Point p = coarse.local(at);
    ASSERT_TRUE(coarse.solution.is_closed(coarse.on_floor(p)));
    const double exact = fine.at(at);
    square += std::pow(coarse.at(at) / exact - 1.0, 2);
    square_solved += std::pow(coarse.solution.illuminance_at(coarse.on_floor(p), p) / exact - 1.0, 2);
    count += 1.0;
  }
  EXPECT_LT(std::sqrt(square / count), 0.01);
  EXPECT_GT(std::sqrt(square_solved / square), 2.0);
}

/// The same, the hole open to a uniform sky of 10,000 lux; all black. Strips that touch lie half-way up, from x = 0 to x = 2.
Study room_under_a_hole(std::size_t strips) {
  mesh::Model room = room_with_hole("air");
  for (std::size_t i = 0; i < strips; ++i) {
    const auto y = [&](std::size_t k) { return 4.0 * static_cast<double>(k) / static_cast<double>(strips); };
    support::add_quad(room, {0, y(i), 1.5}, {2, y(i), 1.5}, {2, y(i + 1), 1.5}, {0, y(i + 1), 1.5},
                      {"sheet", "sheet" + std::to_string(i)});
  }
  Study study = test::study_of(std::move(room), 0.0, {3, 2, 1});
  test::leave_open(test::material(study, "air"));
  study.sky.type = Sky::Type::kUniform;
  study.sky.horizontal_illuminance_lux = 10000.0;
  return study;
}

TEST(LocalPass, OfTheSkyComesThroughTheOpening) {
  const Lit lit(room_under_a_hole(0));
  const Point at{1.3, 2.6, 0};
  const std::array<Point, 4> c{Point{1, 1, 3}, Point{1, 3, 3}, Point{3, 3, 3}, Point{3, 1, 3}};
  std::vector<mesh::OutlineEdge> edges;
  for (std::size_t k = 0; k < 4; ++k) edges.push_back({c[k], c[(k + 1) % 4]});
  const double expected = 10000.0 * point_form_factor(at, {0, 0, 1}, edges, {0, 0, -1});
  EXPECT_NEAR(lit.at(at), expected, 0.01 * expected);
}

// The sheet's shadow ends at x = 1, where the line from the opening's edge x = 3 over the sheet's edge x = 2 meets the floor.
TEST(LocalPass, BehindACrowdRaysThatAllMissTheSkyLeaveAnErrorBehindASheetNone) {
  for (const std::size_t strips : {std::size_t{1}, std::size_t{400}}) {
    const LocalPass::Light light = Lit(room_under_a_hole(strips), 0.02).light({0.99, 2.01, 0});
    EXPECT_EQ(light.lux.at(0), 0.0);
    if (strips == 1) {
      EXPECT_EQ(light.error_lux, 0.0);
    } else {
      EXPECT_GT(light.error_lux, 0.0);
      EXPECT_LT(light.error_lux, 10000.0 / 32.0);
    }
  }
}

TEST(ShownMesh, FollowsThePenumbraOnTheFloor) {
  const Lit lit(lamp_over_shelf());
  const ShownMesh shadows = lit.shown(100000);
  // The penumbra of the edge ends at y = 2 + 2.2 · 0.5 / 0.7 and begins at y = 2: no triangle of the floor lies on both sides.
  const mesh::FaceId floor = lit.solution.tree().face_side(lit.root("floor")).face;
  ASSERT_FALSE(shadows.mesh.of(floor).empty());
  for (const double y : {2.0, 2.0 + 2.2 * 0.5 / 0.7}) {
    for (const mesh::Triangle& t : shadows.mesh.of(floor)) {
      double low = 1e9;
      double high = -1e9;
      double left = 1e9;
      double right = -1e9;
      for (const std::uint32_t v : t.vertices) {
        const Point p = shadows.mesh.vertices[v] + lit.scene.faces.origin;
        low = std::min(low, p.y);
        high = std::max(high, p.y);
        left = std::min(left, p.x);
        right = std::max(right, p.x);
      }
      if (left < 1.5 || right > 2.5) continue;
      EXPECT_FALSE(low < y - 0.011 && high > y + 0.011) << low << " to " << high;
    }
  }
}

TEST(ShownMesh, StaysInItsBudget) {
  const Lit lit(lamp_over_shelf());
  const ShownMesh all = lit.shown(100000);
  // Elements grow before lines go.
  const ShownMesh coarse = lit.shown(all.mesh.triangles.size() / 2);
  EXPECT_LE(coarse.mesh.triangles.size(), all.mesh.triangles.size() / 2 + 10);
  EXPECT_EQ(coarse.found.lines.size(), all.found.lines.size());
  const ShownMesh few = lit.shown(200);
  EXPECT_LE(few.mesh.triangles.size(), 210U);
  EXPECT_LT(few.found.lines.size(), all.found.lines.size());
  EXPECT_EQ(few.found.selection.over_cap, all.found.lines.size() - few.found.lines.size());
}

/// The largest error of a surface's points against straight light, where nothing is reflected [lux].
double worst(const SurfaceResult& surfaces, const Lit& exact) {
  double worst = 0.0;
  for (std::size_t i = 0; i < surfaces.cells.size(); ++i) {
    if (surfaces.material_names.at(static_cast<std::size_t>(surfaces.material[i])) != "floor" || surfaces.side[i] != 0)
      continue;
    for (const std::uint32_t p : surfaces.cells[i]) {
      const Point& at = surfaces.points[p];
      if (at.x < 0.01 || at.x > 5.99 || at.y < 0.01 || at.y > 3.99) continue;
      worst = std::max(worst, std::abs(surfaces.point_illuminance_lux[p] - exact.at(at)));
    }
  }
  return worst;
}

TEST(SurfaceValuesInShadow, PointsMeetTheShadowThatElementsMiss) {
  const Lit lit(lamp_over_shelf(0.0), 0.02);
  const Lit exact(lamp_over_shelf(0.0));
  const ShownMesh shown = lit.shown(100000);
  NoProgress nobody;
  const LitMesh light = light_mesh(lit.solution, shown, lit.local_pass, nobody);
  const double with =
      worst(surface_values(lit.solution, lit.transport.errors, shown, light, lit.local_pass, nobody), exact);
  const double without = worst(surface_values(lit.solution, lit.transport.errors), exact);
  EXPECT_LT(2.0 * with, without);
}

}  // namespace
}  // namespace clerestory::lighting
