// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/hemisphere_links.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "lighting/form_factor.h"
#include "lighting/sampling.h"
#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/path_tracer.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using clerestory::test::pane_optics;
using mesh::ElementId;
using mesh::OutlineEdge;

constexpr std::uint32_t kRays = 128;
constexpr std::uint64_t kSeeds = 128;
/// From the floor of a room of 4 m × 4 m × 3 m to its ceiling.
constexpr double kFloorToCeiling = 0.28273279;

/// With a lamp, without which a closed room has no elements.
Study room() {
  Study study = test::study_of(support::box_room(4, 4, 3), 0.5, {2, 2, 1});
  study.luminaires.push_back(clerestory::test::isotropic_lamp({2, 2, 2}, 1.0));
  return study;
}

double sum_of_factors(const HemisphereView& view) {
  double sum = 0.0;
  for (const SeenSurface& one : view.seen) sum += one.factor;
  return sum;
}

/// The share of even light from the hemisphere that a pane reflects, by another implementation of Fresnel's formulas.
double hemispherical_reflectance(double transmittance_normal) {
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps;
    sum += 2.0 * cosine * pane_optics(transmittance_normal, cosine).reflectance / kSteps;
  }
  return sum;
}

TEST(LookAround, InAClosedRoomTheFactorsAddUpToOne) {
  const test::Stage stage(room());
  for (const std::string part : {"floor", "ceiling", "wall"}) {
    const HemisphereView view = look_around(stage.solution, stage.root(part), kRays, 1);
    EXPECT_EQ(view.rays, kRays);
    EXPECT_EQ(view.seen.size(), kRays);
    EXPECT_NEAR(sum_of_factors(view), 1.0, 1e-5) << part;
  }
}

TEST(LookAround, ShiningSurfacesAreLeftToTheirLinks) {
  Study study = room();
  test::shine(test::material(study, "ceiling"), 100.0);
  const test::Stage stage(study);
  double mean = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const HemisphereView view = look_around(stage.solution, stage.root("floor"), kRays, seed);
    mean += sum_of_factors(view) / kSeeds;
    for (const SeenSurface& one : view.seen)
      EXPECT_FALSE(stage.scene.shines(stage.solution.tree().face_side(one.node)));
  }
  EXPECT_NEAR(mean, 1.0 - kFloorToCeiling, 0.01) << "the ceiling's share is missing";
}

/// A small plate that looks down on a wide pane from 2 m.
mesh::Model plate_over_pane() {
  mesh::Model model;
  support::add_quad(model, {-200, -200, 0}, {200, -200, 0}, {200, 200, 0}, {-200, 200, 0}, {"glass", "glass"});
  support::add_quad(model, {-0.1, -0.1, 2}, {-0.1, 0.1, 2}, {0.1, 0.1, 2}, {0.1, -0.1, 2}, {"plate", "plate"});
  return model;
}

/// Mean over many seeds: what the plate sees, and the sky in the pane.
struct OverPane {
  double factors = 0.0;
  double sky_lux = 0.0;
};
OverPane over_pane(const Study& study) {
  const test::Stage stage(study);
  OverPane mean;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const HemisphereView view = look_around(stage.solution, stage.root("plate"), kRays, seed);
    mean.factors += sum_of_factors(view) / kSeeds;
    mean.sky_lux += view.mirrored_sky_lux / kSeeds;
  }
  return mean;
}

TEST(LookAround, ShiningSurfacesSeenInAPaneCountByWhatItReflects) {
  mesh::Model model = plate_over_pane();
  support::add_quad(model, {-200, -200, 4}, {-200, 200, 4}, {200, 200, 4}, {200, -200, 4}, {"ceiling", "ceiling"});
  Study study = test::study_of(std::move(model), 0.5, {0, 0, 1});
  test::glaze(test::material(study, "glass"));
  test::shine(test::material(study, "ceiling"), 100.0);
  const double expected = hemispherical_reflectance(0.70);
  EXPECT_NEAR(over_pane(study).factors, expected, 0.02 * expected);
}

TEST(LookAround, SkySeenInAPaneIsToldTheSkyItselfIsNot) {
  Study study = test::study_of(plate_over_pane(), 0.5, {0, 0, 1});
  test::glaze(test::material(study, "glass"));
  study.sky.type = Sky::Type::kUniform;
  const double expected = 10'000.0 * hemispherical_reflectance(0.70);
  EXPECT_NEAR(over_pane(study).sky_lux, expected, 0.02 * expected);
  test::leave_open(test::material(study, "glass"));
  EXPECT_EQ(over_pane(study).sky_lux, 0.0);
}

/// A room whose ceiling alone is lit, so that the floor receives 100 lm/m² times the form factor.
struct LitCeiling : test::Stage {
  LitCeiling() : Stage(room()) {
    solution.direct(root("ceiling"))[0] = {200.0F, 0.0F, 0.0F};
    solution.push_pull();
  }
};

TEST(HemisphereView, EstimateIsUnbiasedAndItsErrorCovers) {
  const LitCeiling stage;
  constexpr double kExpected = 100.0 * kFloorToCeiling;
  double sum = 0.0;
  double square = 0.0;
  double stated = 0.0;
  int inside = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const auto e =
        look_around(stage.solution, stage.root("floor"), kRays, seed).estimate(stage.solution, stage.root("floor"));
    const double off = e.mean_lux - kExpected;
    sum += off / kSeeds;
    square += off * off / kSeeds;
    stated += e.error_lux * e.error_lux / kSeeds;
    inside += std::abs(off) <= 2.0 * e.error_lux ? 1 : 0;
  }
  EXPECT_LT(std::abs(sum), 3.0 * std::sqrt(square / kSeeds)) << "unbiased";
  EXPECT_LT(std::sqrt(square), 0.8 * 100.0 * std::sqrt(kFloorToCeiling * (1.0 - kFloorToCeiling) / kRays))
      << "better than independent rays";
  // The variance of the true errors has a standard error of 13 %, that of the stated ones 7 %.
  EXPECT_NEAR(stated / square, 1.0, 0.45);
  // Student's t with three degrees of freedom: 86 % within 2, of 128 that is 110 ± 4.
  EXPECT_GE(inside, 98);
}

TEST(HemisphereView, EstimateFollowsTheRadiositiesAsTheyStand) {
  LitCeiling stage;
  const HemisphereView view = look_around(stage.solution, stage.root("floor"), kRays, 1);
  const double before = view.estimate(stage.solution, stage.root("floor")).mean_lux;
  stage.solution.direct(stage.root("ceiling"))[0].value *= 3.0F;
  stage.solution.push_pull();
  EXPECT_NEAR(view.estimate(stage.solution, stage.root("floor")).mean_lux, 3.0 * before, 1e-4 * before);
}

TEST(HemisphereView, ItsLineRunsAsTheLightDoesOnTheAverage) {
  const LitCeiling stage;
  const ElementId wall = stage.root("wall");
  const mesh::ElementTree& tree = stage.solution.tree();
  const double up_u = tree.axes(wall).u.z;
  const double up_v = tree.axes(wall).v.z;
  std::array<OutlineEdge, 3> scratch;
  const ElementId ceiling = stage.root("ceiling");
  const auto outline = tree.outline(ceiling, scratch);
  // The line's slope upwards, by the exact light at places all over the wall.
  double rise = 0.0;
  double square = 0.0;
  constexpr int kPlaces = 64;
  const SobolPoints numbers(1);
  for (std::uint32_t i = 0; i < kPlaces * kPlaces; ++i) {
    const mesh::Point p = tree.sample(wall, numbers.at(i, 0), numbers.at(i, 1));
    const double height = p.z - tree.centroid(wall).z;
    rise += height * 100.0 * point_form_factor(p, tree.normal(wall), outline, tree.normal(ceiling));
    square += height * height;
  }
  double found = 0.0;
  double scatter = 0.0;
  double stated = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const auto e = look_around(stage.solution, wall, kRays, seed).estimate(stage.solution, wall);
    const double slope = e.mean_lux * (e.slope.slope_u * up_u + e.slope.slope_v * up_v);
    found += slope / kSeeds;
    scatter += std::pow(slope - rise / square, 2.0) / kSeeds;
    stated += e.line_error_lux * e.line_error_lux / kSeeds;
  }
  EXPECT_NEAR(found, rise / square, 3.0 * std::sqrt(scatter / kSeeds));
  EXPECT_LT(std::sqrt(scatter), 0.5 * rise / square);
  // What is stated is of both directions over the wall.
  EXPECT_GT(stated, scatter * square / (kPlaces * kPlaces));
}

TEST(HemisphereView, LinksFromItBringTheEstimate) {
  const LitCeiling stage;
  const HemisphereView view = look_around(stage.solution, stage.root("floor"), kRays, 1);
  double lux = 0.0;
  for (const Link& link : links_to_seen(stage.solution, stage.root("floor"), view.seen, {})) {
    lux += link.factor * stage.solution.radiosity(link.source.element())[0];
  }
  const double estimate = view.estimate(stage.solution, stage.root("floor")).mean_lux;
  EXPECT_NEAR(lux, estimate, 1e-4 * estimate);
}

}  // namespace
}  // namespace clerestory::lighting
