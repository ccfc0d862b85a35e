// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/luminaire_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lighting/form_factor.h"
#include "tests/lighting/stages.h"
#include "tests/support/lamps.h"
#include "tests/support/path_tracer.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using clerestory::test::isotropic_lamp;
using clerestory::test::lambertian_lamp;
using clerestory::test::pane_optics;
using mesh::Model;
using mesh::Point;
using mesh::Vector;

/// Tables of glass are interpolated.
constexpr double kTable = 5e-4;
constexpr double kClear = 0.70;
const Vector kUp{0, 0, 1};

struct AtPoint {
  double x, y, lambertian_lux, isotropic_lux;
};

TEST(IlluminanceBy, MatchesCie171Case52) {
  const Luminaire lambertian = lambertian_lamp({0, 0, 3}, {0, 0, -1}, 1000.0);
  const Luminaire isotropic = isotropic_lamp({0, 0, 3}, 1000.0);
  for (const AtPoint& k : {AtPoint{0, 0, 111.111, 111.111},
                           {.5, 0, 105.186, 106.637},
                           {1, 0, 90.000, 94.868},
                           {1.5, 0, 71.111, 79.505},
                           {.5, .5, 99.723, 102.456},
                           {1, .5, 85.663, 91.419},
                           {1.5, .5, 68.053, 76.926},
                           {1, 1, 74.380, 82.230},
                           {1.5, 1, 59.975, 69.971},
                           {1.5, 1.5, 49.383, 60.481}}) {
    EXPECT_NEAR(illuminance_by(lambertian, {k.x, k.y, 0}, kUp).value, k.lambertian_lux, 6e-4) << k.x << ", " << k.y;
    EXPECT_NEAR(illuminance_by(isotropic, {k.x, k.y, 0}, kUp).value, k.isotropic_lux, 6e-4) << k.x << ", " << k.y;
  }
}

TEST(IlluminanceBy, IsZeroBehindTheSurfaceBehindTheLampAndInIt) {
  const Luminaire lamp = lambertian_lamp({0, 0, 3}, {0, 0, -1}, 1000.0);
  EXPECT_EQ(illuminance_by(lamp, {1, 1, 0}, {0, 0, -1}).value, 0.0);
  EXPECT_EQ(illuminance_by(lamp, {1, 1, 4}, {0, 0, -1}).value, 0.0);
  EXPECT_EQ(illuminance_by(lamp, {0, 0, 3}, kUp).value, 0.0);
}

TEST(LuminaireGuess, IsTheGlanceOnTheAverage) {
  Study study = test::study_of(support::box_room(12, 9, 3), 0.5, {1, 1, 1});
  for (int i = 0; i < 23; ++i)
    study.luminaires.push_back(lambertian_lamp({0.5 * i + 0.3, 1.0 + i % 7, 2.9}, {0, 0, -1}, 100.0 * (i + 1)));
  const test::Stage stage(study);
  const Point at = stage.local({4, 3, 0.8});
  const double exact = luminaire_glance(stage.scene, at, kUp);
  ASSERT_GT(exact, 0.0);
  double mean = 0.0;
  double least = exact;
  constexpr int kPicks = 1000;
  for (int i = 0; i < kPicks; ++i) {
    const double guess = luminaire_guess(stage.scene, at, kUp, (i + 0.5) / kPicks);
    mean += guess / kPicks;
    least = std::min(least, guess);
  }
  EXPECT_NEAR(mean, exact, 1e-3 * exact);
  EXPECT_LT(least, 0.99 * exact);
}

TEST(LuminaireGuess, IsTheGlanceWhereThereAreFew) {
  Study study = test::study_of(support::box_room(12, 9, 3), 0.5, {1, 1, 1});
  for (int i = 0; i < 8; ++i) study.luminaires.push_back(lambertian_lamp({1.3 * i + 0.5, 4, 2.9}, {0, 0, -1}, 1000.0));
  const test::Stage stage(study);
  const Point at = stage.local({4, 3, 0.8});
  EXPECT_EQ(luminaire_guess(stage.scene, at, kUp, 0.3), luminaire_glance(stage.scene, at, kUp));
}

const Luminaire kLamp = isotropic_lamp({2, 0, 2}, 1000.0);
const Point kSensor{1, 0.5, 0};

/// A vertical pane in the plane x = 0 up to some y. From the sensor the lamp's image behind it, at (-2, 0, 2), is seen at y = 1/3.
Model pane_up_to(double y) {
  Model model;
  support::add_quad(model, {0, -3, -1}, {0, y, -1}, {0, y, 3}, {0, -3, 3}, {"glass", "pane"});
  return model;
}
constexpr double kWhereImageIsSeen = 1.0 / 3.0;

Model with(Model model, const Model& other) {
  support::append(model, other);
  return model;
}

/// A square about a point, upright and across the x axis.
Model screen_at(const Point& p, const char* material, double size = 0.4) {
  const double h = 0.5 * size;
  Model model;
  support::add_quad(model, {p.x, p.y - h, p.z - h}, {p.x, p.y + h, p.z - h}, {p.x, p.y + h, p.z + h},
                    {p.x, p.y - h, p.z + h}, {material, material});
  return model;
}

/// Illuminance of the sensor among a lamp and panes of the material "glass".
double lit(const Model& model, const Luminaire& lamp, const Point& at, const Vector& normal) {
  Study study = test::study_of(model, 0.5, at);
  for (Material& m : study.materials) {
    if (m.name == "glass") test::glaze(m, kClear);
    if (m.name == "air") test::leave_open(m);
  }
  study.luminaires.push_back(lamp);
  const test::Stage stage(study);
  return luminaire_illuminance(stage.scene, any_luminaires(stage.scene), stage.local(at), normal, kFineMean).value;
}

double lit(const Model& model) { return lit(model, kLamp, kSensor, kUp); }

/// What the sensor gets of the lamp without the mirror image.
double straight() { return illuminance_by(kLamp, kSensor, kUp).value; }

double cosine_between(const Vector& a, const Vector& b) { return std::abs(dot(normalized(a), normalized(b))); }

/// By the mirror image in the pane x = 0: R(θ) I cos / d², from first principles.
double by_image(const Luminaire& lamp) {
  const Point image{-lamp.at.x, lamp.at.y, lamp.at.z};
  const Vector d = image - kSensor;
  const Vector d_lamp = lamp.at - Point{0, kWhereImageIsSeen, 2.0 / 3.0};
  const double intensity = lamp.intensity_cd(-normalized(d_lamp));
  const double reflectance = pane_optics(kClear, cosine_between(d, {1, 0, 0})).reflectance;
  return reflectance * intensity * dot(normalized(d), kUp) / dot(d, d);
}

/// A horizontal sheet under the lamp and above the sensor of the next tests.
Model ceiling_of(const char* material) {
  Model model;
  support::add_quad(model, {-5, -5, 1}, {5, -5, 1}, {5, 5, 1}, {-5, 5, 1}, {material, material});
  return model;
}

TEST(LuminaireIlluminance, FallsWithTheSquareOfTheDistanceInTheOpen) {
  const Model far_away = screen_at({-20, 0, 0}, "screen");
  const Luminaire lamp = isotropic_lamp({0, 0, 0}, 1000.0);
  EXPECT_NEAR(lit(far_away, lamp, {0, 0, -1}, kUp), 1000.0, 1e-6);
  EXPECT_NEAR(lit(far_away, lamp, {0, 0, -4}, kUp), 1000.0 / 16.0, 1e-6);
}

TEST(LuminaireIlluminance, OpaqueSheetsStopItAirPolygonsDoNot) {
  EXPECT_EQ(lit(ceiling_of("board")), 0.0);
  EXPECT_NEAR(lit(ceiling_of("air")), straight(), 1e-6);
}

TEST(LuminaireIlluminance, BehindGlassIsThatShareWhichItsAngleLetsPass) {
  for (const double x : {0.0, 0.7, 2.0, 4.0}) {
    const Luminaire lamp = isotropic_lamp({x, 0, 2}, 1000.0);
    const double cosine = cosine_between(lamp.at - Point{0, 0, 0}, kUp);
    const double free = illuminance_by(lamp, {0, 0, 0}, kUp).value;
    const double expected = pane_optics(kClear, cosine).transmittance * free;
    EXPECT_NEAR(lit(ceiling_of("glass"), lamp, {0, 0, 0}, kUp), expected, kTable * free) << x;
  }
}

TEST(LuminaireIlluminance, TwoPanesMultiply) {
  const Model two = with(ceiling_of("glass"), support::moved(ceiling_of("glass"), {0, 0, 0.3}));
  const double t = pane_optics(kClear, cosine_between(kLamp.at - kSensor, kUp)).transmittance;
  EXPECT_NEAR(lit(two), t * t * straight(), kTable * straight());
}

TEST(LuminaireIlluminance, PaneBesideAddsTheMirrorImage) {
  const Luminaire beam = lambertian_lamp(kLamp.at, {-1, 0, -0.3}, 1000.0);
  for (const Luminaire& lamp : {kLamp, beam}) {
    ASSERT_GT(by_image(lamp), 1.0);
    const double expected = illuminance_by(lamp, kSensor, kUp).value + by_image(lamp);
    EXPECT_NEAR(lit(pane_up_to(3), lamp, kSensor, kUp), expected, 0.01 * by_image(lamp));
  }
}

TEST(LuminaireIlluminance, PanesEdgeCutsTheImage) {
  EXPECT_NEAR(lit(pane_up_to(kWhereImageIsSeen + 0.01)) - straight(), by_image(kLamp), 0.01 * by_image(kLamp));
  EXPECT_NEAR(lit(pane_up_to(kWhereImageIsSeen - 0.01)) - straight(), 0.0, 1e-9);
}

TEST(LuminaireIlluminance, ImageIsHiddenByWhatStandsOnEitherLeg) {
  const Point mirror{0, kWhereImageIsSeen, 2.0 / 3.0};
  for (const Point& end : {kSensor, kLamp.at}) {
    const Model hidden = with(pane_up_to(3), screen_at(mirror + 0.3 * (end - mirror), "screen"));
    EXPECT_NEAR(lit(hidden) - straight(), 0.0, 1e-9);
  }
}

TEST(LuminaireIlluminance, NothingBehindThePaneHidesTheImage) {
  const Model wall =
      with(pane_up_to(3), screen_at(mesh::midpoint({0, kWhereImageIsSeen, 2.0 / 3.0}, {-2, 0, 2}), "screen"));
  EXPECT_NEAR(lit(wall) - straight(), by_image(kLamp), 0.01 * by_image(kLamp));
}

TEST(LuminaireIlluminance, GlassOnTheWayToTheMirrorTakesItsShareOfTheImage) {
  const Point mirror{0, kWhereImageIsSeen, 2.0 / 3.0};
  // An upright pane halfway, in which the lamp has no image for the sensor: too small.
  const Model model = with(pane_up_to(3), screen_at(mesh::midpoint(mirror, kSensor), "glass", 0.2));
  const double t = pane_optics(kClear, cosine_between(mirror - kSensor, {1, 0, 0})).transmittance;
  EXPECT_NEAR(lit(model) - straight(), t * by_image(kLamp), 0.01 * by_image(kLamp));
}

/// A square panel of 0.6 m that shines like a Lambertian surface of so many cd on its axis.
Luminaire panel_at(const Point& at, double size_m = 0.6) {
  Luminaire panel = lambertian_lamp(at, {0, 0, -1}, 1000.0);
  panel.opening = {.shape = LuminousOpening::Shape::kRectangle, .x_m = size_m, .y_m = size_m};
  return panel;
}

TEST(IlluminanceBy, OfALambertianPanelIsThatOfAnEmittingSquare) {
  const Luminaire panel = panel_at({0, 0, 2});
  const double exitance = std::numbers::pi * 1000.0 / 0.36;
  std::vector<mesh::OutlineEdge> edges;
  const Point corners[] = {{-.3, -.3, 2}, {-.3, .3, 2}, {.3, .3, 2}, {.3, -.3, 2}};
  for (std::size_t k = 0; k < 4; ++k) edges.push_back({corners[k], corners[(k + 1) % 4]});
  for (const Point& at : {Point{0, 0, 0}, {0, 0, 1.5}, {0.5, 0.2, 1.7}, {1, 1, 1}}) {
    const double expected = exitance * point_form_factor(at, kUp, edges, {0, 0, -1});
    const AreaMean light = illuminance_by(panel, at, kUp);
    EXPECT_NEAR(light.value, expected, 1e-3 * expected) << at.z;
    EXPECT_LE(std::abs(light.value - expected), 2.0 * light.error + 1e-5 * expected) << at.z;
  }
}

TEST(IlluminanceBy, BeyondFiveTimesItsSizeIsThatOfAPoint) {
  const Luminaire panel = panel_at({0, 0, 10});
  const Luminaire point = lambertian_lamp({0, 0, 10}, {0, 0, -1}, 1000.0);
  EXPECT_EQ(illuminance_by(panel, {1, 0, 0}, kUp).value, illuminance_by(point, {1, 0, 0}, kUp).value);
}

TEST(LuminaireIlluminance, CeilingAndHousingDoNotHideWhatIsMountedInThem) {
  Model room = ceiling_of("ceiling");
  support::append(room, screen_at({5, 5, -5}, "far"));
  for (const double z : {0.98, 1.0, 1.02, 1.045}) {
    const Luminaire panel = panel_at({0, 0, z});
    const double free = illuminance_by(panel, {3, 0, 0}, kUp).value;
    EXPECT_NEAR(lit(room, panel, {3, 0, 0}, kUp), free, 1e-9 * free) << z;
  }
  EXPECT_EQ(lit(room, panel_at({0, 0, 1.1}), {3, 0, 0}, kUp), 0.0);
  const Model housing = screen_at({0.32, 0, 1.5}, "housing", 0.04);
  const Luminaire pendant = panel_at({0, 0, 1.5});
  EXPECT_NEAR(lit(housing, pendant, {3, 0, 0}, kUp), illuminance_by(pendant, {3, 0, 0}, kUp).value, 1e-9);
}

TEST(LuminaireIlluminance, NothingShinesThroughTheCeilingItHangsFrom) {
  Luminaire all_round = panel_at({0, 0, 0.98});
  all_round.web = isotropic_lamp({}, 100.0).web;
  EXPECT_EQ(lit(ceiling_of("ceiling"), all_round, {0.5, 0, 2}, {0, 0, -1}), 0.0);
}

TEST(LuminaireIlluminance, HalfHiddenPanelGivesHalf) {
  // A screen whose edge halves the panel, seen from straight below.
  Model screen;
  support::add_quad(screen, {0, -5, 1}, {5, -5, 1}, {5, 5, 1}, {0, 5, 1}, {"board", "board"});
  const Luminaire panel = panel_at({0, 0, 2});
  const double free = illuminance_by(panel, {0, 0, 0}, kUp).value;
  EXPECT_NEAR(lit(screen, panel, {0, 0, 0}, kUp), 0.5 * free, 1e-4 * free);
}

}  // namespace
}  // namespace clerestory::lighting
