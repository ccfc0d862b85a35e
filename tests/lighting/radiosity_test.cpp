// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/radiosity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/path_tracer.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using clerestory::test::pane_optics;
using mesh::ElementId;
using mesh::Point;
using test::Solved;

/// Relative distance of the fronts' radiosity from a value: of the mean, and of the element that is farthest off.
struct Deviation {
  double mean = 0.0;
  double largest = 0.0;
};
Deviation deviation_of_fronts(const Solved& s, double radiosity) {
  Deviation d;
  double area = 0.0;
  for (const ElementId e : s.solution.elements()) {
    if (s.solution.tree().face_side(e).side != mesh::Side::kFront) continue;
    const double relative = s.solution.radiosity(e)[0] / radiosity - 1.0;
    d.mean += s.solution.tree().area(e) * relative;
    area += s.solution.tree().area(e);
    d.largest = std::max(d.largest, std::abs(relative));
  }
  d.mean /= area;
  return d;
}

void expect_furnace(const Study& study, double radiosity) {
  const Deviation d = deviation_of_fronts(Solved(study), radiosity);
  EXPECT_LT(std::abs(d.mean), 1e-4);
  EXPECT_LT(d.largest, study.accuracy.target / 4.0);
}

/// Sensors that look up, down and to either side from all over the box room: every surface matters.
void look_everywhere(Study& study) {
  for (const double x : {0.5, 1.5, 2.5, 3.5}) {
    for (const double y : {0.5, 1.8, 3.2, 4.5}) {
      for (const mesh::Vector& n : {mesh::Vector{0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}) {
        study.grids[0].points.push_back({x, y, 1.5});
        study.grids[0].normals.push_back(n);
      }
    }
  }
}

TEST(Radiosity, FurnaceOfOneMaterialKeepsItsRadiosity) {
  Study study = test::study_of(support::box_room(4, 5, 3), 0.75, {2, 2, 1});
  look_everywhere(study);
  for (Material& m : study.materials) test::shine(m, 10.0);
  expect_furnace(study, 40.0);
}

TEST(Radiosity, FurnaceOfManyMaterialsKeepsItsRadiosity) {
  // Whatever its reflectance, a side that sends out M = B(1 − ρ) keeps the room at B.
  Study study = test::study_of(support::box_room(4, 5, 3), 0.5, {2, 2, 1});
  look_everywhere(study);
  float reflectance = 0.1F;
  for (Material& m : study.materials) {
    m.front.reflectance = Spectrum{reflectance};
    test::shine(m, 40.0 * (1.0 - reflectance));
    reflectance += 0.35F;
  }
  expect_furnace(study, 40.0);
}

TEST(Radiosity, FurnaceWithAPaneThatTakesNothingKeepsItsRadiosity) {
  // What the pane does not let pass, it mirrors: from either side the room looks as bright as without it.
  mesh::Model model = support::box_room(4, 5, 3);
  support::add_quad(model, {0.5, 2.5, 0.3}, {3.5, 2.5, 0.3}, {3.5, 2.5, 2.7}, {0.5, 2.5, 2.7}, {"glass", "pane"});
  Study study = test::study_of(std::move(model), 0.75, {2, 2, 1});
  look_everywhere(study);
  for (Material& m : study.materials) test::shine(m, 10.0);
  test::glaze(test::material(study, "glass"), 0.918);
  const Solved s(study);
  double mean = 0.0;
  double square = 0.0;
  double area = 0.0;
  for (const ElementId e : s.solution.elements()) {
    const mesh::FaceSide side = s.solution.tree().face_side(e);
    if (side.side != mesh::Side::kFront || s.scene.is_pane(side)) continue;
    const double relative = s.solution.radiosity(e)[0] / 40.0 - 1.0;
    mean += s.solution.tree().area(e) * relative;
    square += s.solution.tree().area(e) * relative * relative;
    area += s.solution.tree().area(e);
  }
  EXPECT_LT(std::abs(mean / area), 1e-3);
  EXPECT_LT(std::sqrt(square / area), study.accuracy.target / 4.0);
}

/// A lamp of 1 m × 1 m at z = 1.5 over a wide pane at z = 0, and around it, at z = 1, four plates of 0.5 m × 0.5 m that look down:
/// they get light from the lamp's mirror image alone.
Study lamp_over_pane() {
  mesh::Model model;
  support::add_quad(model, {-7, -7, 0}, {7, -7, 0}, {7, 7, 0}, {-7, 7, 0}, {"glass", "glass"});
  support::add_quad(model, {-0.5, -0.5, 1.5}, {-0.5, 0.5, 1.5}, {0.5, 0.5, 1.5}, {0.5, -0.5, 1.5}, {"lamp", "lamp"});
  const std::vector<Point> plates{{1.75, 0, 1}, {-1.75, 0, 1}, {0, 1.75, 1}, {0, -1.75, 1}};
  for (const Point& p : plates) {
    const double h = 0.25;
    support::add_quad(model, {p.x - h, p.y - h, p.z}, {p.x - h, p.y + h, p.z}, {p.x + h, p.y + h, p.z},
                      {p.x + h, p.y - h, p.z}, {"plate", "plate"});
  }
  Study study = test::study_of(std::move(model), 0.2, {});
  study.grids[0].points.clear();
  for (const Point& p : plates) study.grids[0].points.push_back({p.x, p.y, 0.98});
  study.grids[0].normals.assign(plates.size(), {0, 0, 1});
  test::shine(test::material(study, "lamp"), 1000.0);
  test::glaze(test::material(study, "glass"));
  study.accuracy.target = 0.2;  // of next to nothing: the sensors look at plates that only the mirror lights
  return study;
}

/// What a plate gets of the lamp's image at z = -1.5: the form factor times R(θ), by brute force.
double from_the_image() {
  constexpr int kSteps = 24;
  constexpr double kPairs = 1.0 * kSteps * kSteps * kSteps * kSteps;
  const auto place = [](int digit) { return (digit + 0.5) / kSteps - 0.5; };
  double sum = 0.0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const Point p{1.75 + 0.5 * place(i / kSteps), 0.5 * place(i % kSteps), 1.0};
    for (int j = 0; j < kSteps * kSteps; ++j) {
      const mesh::Vector d = Point{place(j / kSteps), place(j % kSteps), -1.5} - p;
      const double cosine = -d.z / norm(d);
      sum += cosine * cosine / (std::numbers::pi * dot(d, d)) * pane_optics(0.70, cosine).reflectance;
    }
  }
  return 1000.0 * sum / kPairs;
}

TEST(Radiosity, PaneSendsLightOnAsAMirror) {
  const Solved s(lamp_over_pane());
  const double expected = from_the_image();
  EXPECT_NEAR(s.mean_illuminance(s.roots("plate")), expected, 0.03 * expected);
}

TEST(Radiosity, MeanInAClosedRoomIsTheIntegratingSpheres) {
  // Φ/(A(1 − ρ)), of which the direct light is Φ/A.
  for (const double rho : {0.2, 0.5, 0.8}) {
    Study study = test::study_of(support::box_room(4, 5, 3), rho, {2, 2, 1});
    study.luminaires.push_back(clerestory::test::isotropic_lamp({1.3, 2.1, 1.7}, 10'000.0 / (4.0 * std::numbers::pi)));
    const Solved s(study);
    std::vector<ElementId> fronts;
    for (const std::string part : {"floor", "ceiling", "wall"}) {
      for (const ElementId e : s.roots(part)) fronts.push_back(e);
    }
    const double expected = 10'000.0 / (94.0 * (1.0 - rho));
    EXPECT_NEAR(s.mean_illuminance(fronts), expected, 0.005 * expected) << rho;
  }
}

/// A regular icosahedron, each face cut into four and blown up to a sphere.
void add_sphere(mesh::Model& model, double radius, bool outward, const std::string& material) {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  const std::array<mesh::Vector, 12> v{{{-1, g, 0},
                                        {1, g, 0},
                                        {-1, -g, 0},
                                        {1, -g, 0},
                                        {0, -1, g},
                                        {0, 1, g},
                                        {0, -1, -g},
                                        {0, 1, -g},
                                        {g, 0, -1},
                                        {g, 0, 1},
                                        {-g, 0, -1},
                                        {-g, 0, 1}}};
  constexpr std::array<std::array<std::size_t, 3>, 20> kFaces{
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  const auto on_sphere = [&](const mesh::Vector& d) { return Point{} + radius * normalized(d); };
  for (const auto& f : kFaces) {
    const std::array<Point, 3> c{on_sphere(v[f[0]]), on_sphere(v[f[1]]), on_sphere(v[f[2]])};
    std::array<Point, 3> m;
    for (std::size_t k = 0; k < 3; ++k) m[k] = on_sphere(midpoint(c[k], c[(k + 1) % 3]) - Point{});
    for (const auto& t :
         {std::array{c[0], m[0], m[2]}, std::array{m[0], c[1], m[1]}, std::array{m[2], m[1], c[2]}, m}) {
      if (outward) {
        support::add_triangle(model, t[0], t[1], t[2], {material, material});
      } else {
        support::add_triangle(model, t[0], t[2], t[1], {material, material});
      }
    }
  }
}

TEST(Radiosity, BodyInASphereFollowsTheTwoSurfaceEnclosure) {
  mesh::Model model;
  add_sphere(model, 0.5, true, "inner");
  add_sphere(model, 1.0, false, "outer");
  Study study = test::study_of(std::move(model), 0.5, {0, 0, 0.75});
  test::material(study, "outer").front.reflectance = Spectrum{0.8F};
  test::shine(test::material(study, "inner"), 1000.0);
  study.accuracy.target = 0.005;
  const Solved s(study);
  double inner = 0.0;
  double outer = 0.0;
  for (const ElementId e : s.roots("inner")) inner += s.solution.tree().area(e);
  for (const ElementId e : s.roots("outer")) outer += s.solution.tree().area(e);
  // E1 = B2, E2 = f B1 + (1 − f) B2, f = A1/A2; B1 = M + ρ1 E1, B2 = ρ2 E2.
  const double f = inner / outer;
  const double b2 = 0.8 * f * 1000.0 / (1.0 - 0.8 * (1.0 - f) - 0.8 * f * 0.5);
  EXPECT_NEAR(s.mean_illuminance(s.roots("inner")), b2, 0.01 * b2);
  EXPECT_NEAR(s.mean_illuminance(s.roots("outer")), b2 / 0.8, 0.01 * b2 / 0.8);
}

Study lamp_room() {
  Study study = test::study_of(support::box_room(4, 4, 3), 0.5, {2, 2, 1});
  test::shine(test::material(study, "ceiling"), 100.0);
  return study;
}

TEST(Radiosity, TwiceTheLightGivesTwiceTheResultToTheBit) {
  Study bright = lamp_room();
  test::shine(test::material(bright, "ceiling"), 200.0);
  const Solved one(lamp_room());
  const Solved two(bright);
  ASSERT_EQ(one.transport.arrivals.count(), two.transport.arrivals.count());
  const auto elements = one.solution.elements();
  ASSERT_EQ(elements, two.solution.elements());
  for (const ElementId e : elements) {
    ASSERT_EQ(2.0F * one.solution.irradiance(e)[0].value, two.solution.irradiance(e)[0].value);
  }
}

TEST(Radiosity, WhereNothingShinesThereIsNothingToLink) {
  mesh::Model model = support::box_room(4, 4, 3);
  for (int i = 0; i < 60; ++i)
    support::add_quad(model, {0.5, 0.05 * i, 1}, {1, 0.05 * i, 1}, {1, 0.05 * i + 0.04, 1}, {0.5, 0.05 * i + 0.04, 1},
                      {"slat", "slat"});
  const Solved dark(test::study_of(std::move(model), 0.5, {2, 2, 0.8}));
  EXPECT_EQ(dark.transport.arrivals.count(), 0U);
  EXPECT_EQ(dark.solution.elements().size(), dark.solution.tree().roots().size());
}

TEST(Radiosity, IteratesUntilWhatIsMissingIsFarBelowTheAccuracy) {
  Study study = lamp_room();
  for (Material& m : study.materials) m.front.reflectance = Spectrum{0.95F};
  const Solved s(study);
  EXPECT_LE(s.transport.convergence, 1e-3 * study.accuracy.target);
  EXPECT_GT(s.transport.iterations, 10U);
}

TEST(Radiosity, OnlyElementsAndGroupsAboveThemReceive) {
  const Solved s(lamp_room());
  for (std::size_t i = 0; i < s.transport.arrivals.receivers(); ++i) {
    const ElementId parent = s.solution.tree().parent(s.transport.arrivals.receiver(i));
    EXPECT_TRUE(!parent.valid() || s.solution.is_open(parent));
  }
}

TEST(Radiosity, ErrorsOfLinksAreKeptOnlyWhereAskedFor) {
  EXPECT_FALSE(Solved(lamp_room()).transport.arrivals.has_errors());
  Study kept = lamp_room();
  kept.keep_solution = true;
  EXPECT_TRUE(Solved(kept).transport.arrivals.has_errors());
}

/// Weights of so many bands, most for those in the middle.
std::vector<float> weights_of(std::size_t bands) {
  std::vector<float> weights;
  for (std::size_t b = 0; b < bands; ++b) weights.push_back(static_cast<float>((b + 1) * (bands - b)));
  const float sum = std::accumulate(weights.begin(), weights.end(), 0.0F);
  for (float& w : weights) w /= sum;
  return weights;
}

TEST(Radiosity, AFurnaceIsExactInEachOf9And81Bands) {
  for (const std::size_t bands : {std::size_t{9}, std::size_t{81}}) {
    Spectrum rho;
    for (std::size_t b = 0; b < bands; ++b)
      rho.push_back(0.1F + 0.7F * static_cast<float>(b) / static_cast<float>(bands - 1));
    Study study = test::study_of(support::box_room(4, 3, 2), 0.5, {2, 1, 1});
    study.band_weights = weights_of(bands);
    for (Material& m : study.materials) {
      m.front.reflectance = rho;
      test::shine(m, 100.0);
    }
    const Solved s(study);
    ASSERT_EQ(s.solution.channels(), bands);
    for (const ElementId e : s.solution.elements()) {
      if (!s.scene.shines(s.solution.tree().face_side(e))) continue;
      for (std::size_t b = 0; b < bands; ++b)
        EXPECT_NEAR(s.solution.radiosity(e)[b] * (1.0F - rho[b]) / 100.0F, 1.0, 1.5e-4) << b;
    }
  }
}

TEST(Radiosity, BlackSurfacesSendNothingBack) {
  Study study = lamp_room();
  for (Material& m : study.materials) m.front.reflectance = m.back.reflectance = Spectrum{0.0F};
  const Solved s(study);
  EXPECT_EQ(s.mean_illuminance(s.roots("ceiling")), 0.0);
  EXPECT_NEAR(s.mean_illuminance(s.roots("floor")), 100.0 * 0.28273279, 0.05);
  EXPECT_NEAR(s.mean_illuminance(s.roots("wall")), 100.0 * 0.17931680 * 16.0 / 12.0, 0.05);
}

/// The lamp room, with a plate out of doors that light never reaches.
Study with_plate(const Spectrum& plate) {
  mesh::Model model = support::box_room(4, 4, 3);
  support::add_quad(model, {9, 0, 0}, {10, 0, 0}, {10, 1, 0}, {9, 1, 0}, {"plate", "plate"});
  Study study = test::study_of(std::move(model), 0.5, {2, 2, 1});
  test::shine(test::material(study, "ceiling"), 100.0);
  Material& m = test::material(study, "plate");
  m.front.reflectance = m.back.reflectance = plate;
  return study;
}

TEST(Radiosity, GreyRoomIsTheSameInOneChannelAndInThree) {
  const Solved one(with_plate({0.5F}));
  const Solved three(with_plate({0.5F, 0.4F, 0.3F}));
  ASSERT_EQ(one.solution.channels(), 1U);
  ASSERT_EQ(three.solution.channels(), 3U);
  const auto elements = one.solution.elements();
  ASSERT_EQ(elements, three.solution.elements());
  for (const ElementId e : elements) {
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_NEAR(three.solution.irradiance(e)[c].value, one.solution.irradiance(e)[0].value, 1e-3);
    }
  }
}

TEST(Radiosity, GreyRoomIsTheSameInOneChannelAndIn81) {
  const Solved one(with_plate({0.5F}));
  Spectrum plate(81, 0.5F);
  plate.back() = 0.3F;
  Study study = with_plate(plate);
  study.band_weights = weights_of(81);
  const Solved many(study);
  ASSERT_EQ(many.solution.channels(), 81U);
  ASSERT_EQ(one.solution.elements(), many.solution.elements());
  for (const ElementId e : one.solution.elements()) {
    for (const LinearValue& lux : many.solution.irradiance(e))
      ASSERT_NEAR(lux.value, one.solution.irradiance(e)[0].value, 1e-3);
  }
}

TEST(Radiosity, ColouredRoomIsThreeGreyRooms) {
  constexpr double kFine = 0.005;  // an accuracy is that of the mix: the darkest channel is a third of it
  const std::array<float, 3> wall{0.8F, 0.5F, 0.1F};
  Study coloured = lamp_room();
  coloured.accuracy.target = kFine;
  test::material(coloured, "wall").front.reflectance = Spectrum(wall.begin(), wall.end());
  const Solved together(coloured);
  for (std::size_t c = 0; c < 3; ++c) {
    Study grey = lamp_room();
    grey.accuracy.target = kFine;
    test::material(grey, "wall").front.reflectance = Spectrum{wall[c]};
    const Solved alone(grey);
    for (const std::string part : {"floor", "ceiling", "wall"}) {
      const double expected = alone.mean_illuminance(alone.roots(part));
      EXPECT_NEAR(together.mean_illuminance(together.roots(part), c), expected, 2e-3 * expected) << part << ", " << c;
    }
  }
}

}  // namespace
}  // namespace clerestory::lighting
