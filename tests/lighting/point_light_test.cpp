// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/point_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/lighting/stages.h"
#include "tests/support/path_tracer.h"
#include "tests/support/shapes.h"

namespace clerestory::lighting {
namespace {

using clerestory::test::pane_optics;
using mesh::Model;
using mesh::Point;
using mesh::Vector;

/// Tables of glass are interpolated.
constexpr double kTable = 5e-4;
constexpr double kClear = 0.70;

struct AtPoint {
  double x, y, lambertian_lux, isotropic_lux;
};

TEST(PointIlluminance, MatchesCie171Case52) {
  PointSource lamp{.at = {0, 0, 3}, .intensity_cd = 1000.0, .lambertian = true};
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
    lamp.lambertian = true;
    EXPECT_NEAR(point_illuminance(lamp, {k.x, k.y, 0}, {0, 0, 1}), k.lambertian_lux, 6e-4) << k.x << ", " << k.y;
    lamp.lambertian = false;
    EXPECT_NEAR(point_illuminance(lamp, {k.x, k.y, 0}, {0, 0, 1}), k.isotropic_lux, 6e-4) << k.x << ", " << k.y;
  }
}

TEST(PointIlluminance, IsZeroBehindTheSurfaceBehindTheLampAndInIt) {
  const PointSource lamp{.at = {0, 0, 3}, .intensity_cd = 1000.0, .lambertian = true};
  EXPECT_EQ(point_illuminance(lamp, {1, 1, 0}, {0, 0, -1}), 0.0);
  EXPECT_EQ(point_illuminance(lamp, {1, 1, 4}, {0, 0, -1}), 0.0);
  EXPECT_EQ(point_illuminance(lamp, {0, 0, 3}, {0, 0, 1}), 0.0);
}

const PointSource kLamp{.at = {2, 0, 2}, .intensity_cd = 1000.0};
const Point kSensor{1, 0.5, 0};
const Vector kUp{0, 0, 1};

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
double lit(const Model& model, const PointSource& lamp, const Point& at, const Vector& normal) {
  Study study = test::study_of(model, 0.5, at);
  for (Material& m : study.materials) {
    if (m.name == "glass") test::glaze(m, kClear);
    if (m.name == "air") test::leave_open(m);
  }
  study.point_sources.push_back(lamp);
  const test::Stage stage(study);
  return point_source_illuminance(stage.scene, stage.local(at), normal);
}

double lit(const Model& model) { return lit(model, kLamp, kSensor, kUp); }

/// What the sensor gets of the lamp without the mirror image.
double straight() { return point_illuminance(kLamp, kSensor, kUp); }

double cosine_between(const Vector& a, const Vector& b) { return std::abs(dot(normalized(a), normalized(b))); }

/// By the mirror image in the pane x = 0: R(θ) I cos / d², from first principles.
double by_image(const PointSource& lamp) {
  const Point image{-lamp.at.x, lamp.at.y, lamp.at.z};
  const Vector d = image - kSensor;
  const double towards =
      lamp.lambertian ? std::max(0.0, -dot(normalized(d), Vector{-lamp.aim.x, lamp.aim.y, lamp.aim.z})) : 1.0;
  const double reflectance = pane_optics(kClear, cosine_between(d, {1, 0, 0})).reflectance;
  return reflectance * lamp.intensity_cd * towards * dot(normalized(d), kUp) / dot(d, d);
}

/// A horizontal sheet under the lamp and above the sensor of the next tests.
Model ceiling_of(const char* material) {
  Model model;
  support::add_quad(model, {-5, -5, 1}, {5, -5, 1}, {5, 5, 1}, {-5, 5, 1}, {material, material});
  return model;
}

TEST(PointSourceIlluminance, FallsWithTheSquareOfTheDistanceInTheOpen) {
  const Model far_away = screen_at({-20, 0, 0}, "screen");
  const PointSource lamp{.at = {0, 0, 0}, .intensity_cd = 1000.0};
  EXPECT_NEAR(lit(far_away, lamp, {0, 0, -1}, kUp), 1000.0, 1e-6);
  EXPECT_NEAR(lit(far_away, lamp, {0, 0, -4}, kUp), 1000.0 / 16.0, 1e-6);
}

TEST(PointSourceIlluminance, OpaqueSheetsStopItAirPolygonsDoNot) {
  EXPECT_EQ(lit(ceiling_of("board")), 0.0);
  EXPECT_NEAR(lit(ceiling_of("air")), straight(), 1e-6);
}

TEST(PointSourceIlluminance, BehindGlassIsThatShareWhichItsAngleLetsPass) {
  for (const double x : {0.0, 0.7, 2.0, 4.0}) {
    const PointSource lamp{.at = {x, 0, 2}, .intensity_cd = 1000.0};
    const double cosine = cosine_between(lamp.at - Point{0, 0, 0}, kUp);
    const double free = point_illuminance(lamp, {0, 0, 0}, kUp);
    const double expected = pane_optics(kClear, cosine).transmittance * free;
    EXPECT_NEAR(lit(ceiling_of("glass"), lamp, {0, 0, 0}, kUp), expected, kTable * free) << x;
  }
}

TEST(PointSourceIlluminance, TwoPanesMultiply) {
  const Model two = with(ceiling_of("glass"), support::moved(ceiling_of("glass"), {0, 0, 0.3}));
  const double t = pane_optics(kClear, cosine_between(kLamp.at - kSensor, kUp)).transmittance;
  EXPECT_NEAR(lit(two), t * t * straight(), kTable * straight());
}

TEST(PointSourceIlluminance, PaneBesideAddsTheMirrorImage) {
  PointSource beam = kLamp;
  beam.aim = normalized(Vector{-1, 0, -0.3});
  beam.lambertian = true;
  for (const PointSource& lamp : {kLamp, beam}) {
    ASSERT_GT(by_image(lamp), 1.0);
    const double expected = point_illuminance(lamp, kSensor, kUp) + by_image(lamp);
    EXPECT_NEAR(lit(pane_up_to(3), lamp, kSensor, kUp), expected, 0.01 * by_image(lamp)) << lamp.lambertian;
  }
}

TEST(PointSourceIlluminance, PanesEdgeCutsTheImage) {
  EXPECT_NEAR(lit(pane_up_to(kWhereImageIsSeen + 0.01)) - straight(), by_image(kLamp), 0.01 * by_image(kLamp));
  EXPECT_NEAR(lit(pane_up_to(kWhereImageIsSeen - 0.01)) - straight(), 0.0, 1e-9);
}

TEST(PointSourceIlluminance, ImageIsHiddenByWhatStandsOnEitherLeg) {
  const Point mirror{0, kWhereImageIsSeen, 2.0 / 3.0};
  for (const Point& end : {kSensor, kLamp.at}) {
    const Model hidden = with(pane_up_to(3), screen_at(mirror + 0.3 * (end - mirror), "screen"));
    EXPECT_NEAR(lit(hidden) - straight(), 0.0, 1e-9);
  }
}

TEST(PointSourceIlluminance, NothingBehindThePaneHidesTheImage) {
  const Model wall =
      with(pane_up_to(3), screen_at(mesh::midpoint({0, kWhereImageIsSeen, 2.0 / 3.0}, {-2, 0, 2}), "screen"));
  EXPECT_NEAR(lit(wall) - straight(), by_image(kLamp), 0.01 * by_image(kLamp));
}

TEST(PointSourceIlluminance, GlassOnTheWayToTheMirrorTakesItsShareOfTheImage) {
  const Point mirror{0, kWhereImageIsSeen, 2.0 / 3.0};
  // An upright pane halfway, in which the lamp has no image for the sensor: too small.
  const Model model = with(pane_up_to(3), screen_at(mesh::midpoint(mirror, kSensor), "glass", 0.2));
  const double t = pane_optics(kClear, cosine_between(mirror - kSensor, {1, 0, 0})).transmittance;
  EXPECT_NEAR(lit(model) - straight(), t * by_image(kLamp), 0.01 * by_image(kLamp));
}

}  // namespace
}  // namespace clerestory::lighting
