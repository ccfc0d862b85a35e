// SPDX-License-Identifier: GPL-3.0-or-later
// A room without a right angle behind louvres, with a leaning slab across the street: daylight against the path tracer of tests/support.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/shapes.h"
#include "tests/support/traced_scene.h"
#include "tests/validation/statistics.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

using mesh::Point;
using mesh::Vector;

constexpr double kHeight_m = 2.9;
constexpr double kWorkPlane_m = 0.8;
constexpr std::size_t kSlats = 16;

/// Counter-clockwise, the window wall from the first corner to the second; angles of 84°, 107°, 61°, 108°.
const std::array<Point, 4> kPlan{Point{0.0, 0.0, 0.0}, {5.2, 1.1, 0.0}, {5.6, 6.3, 0.0}, {0.9, 4.6, 0.0}};

/// A place on the window wall: along it from its first corner, up, and out of the room [m].
Point on_facade(double along, double up, double out) {
  const double length = std::hypot(kPlan[1].x, kPlan[1].y);
  const Vector u{kPlan[1].x / length, kPlan[1].y / length, 0.0};
  return kPlan[0] + along * u + out * Vector{u.y, -u.x, 0.0} + Vector{0, 0, up};
}

void add_shell(mesh::Model& model) {
  const auto top = [](const Point& p) { return p + Vector{0, 0, kHeight_m}; };
  support::add_polygon(model, kPlan, {"floor", "room"});
  support::add_polygon(model, {top(kPlan[3]), top(kPlan[2]), top(kPlan[1]), top(kPlan[0])}, {"ceiling", "room"});
  for (std::size_t i = 1; i < kPlan.size(); ++i) {
    const Point& a = kPlan[i];
    const Point& b = kPlan[(i + 1) % kPlan.size()];
    support::add_quad(model, b, a, top(a), top(b), {"wall", "room"});
  }
  const std::vector<Point> window = {on_facade(0.9, 0.95, 0), on_facade(4.3, 0.95, 0), on_facade(4.3, 2.45, 0),
                                     on_facade(0.9, 2.45, 0)};
  const std::vector<Point> wall = {kPlan[1], kPlan[0], top(kPlan[0]), top(kPlan[1])};
  support::add_polygon(model, wall, {"wall", "room"}, {window});
  support::add_polygon(model, window, {"glass", "room"});
}

/// Slats of 12 cm, every 10 cm, tilted by 25° so that they let the ground's light in and keep the high sky out.
void add_louvre(mesh::Model& model) {
  const double depth_m = 0.12;
  const double tilt = 25.0 * std::numbers::pi / 180.0;
  for (std::size_t i = 0; i < kSlats; ++i) {
    const double z = 0.98 + 0.1 * static_cast<double>(i);
    const double out = 0.10 + depth_m * std::cos(tilt);
    const double drop = depth_m * std::sin(tilt);
    support::add_quad(model, on_facade(0.85, z, 0.10), on_facade(4.35, z, 0.10), on_facade(4.35, z - drop, out),
                      on_facade(0.85, z - drop, out), {"slat", "slat " + std::to_string(i)});
  }
}

mesh::Model louvred_room() {
  mesh::Model model;
  add_shell(model);
  add_louvre(model);
  support::add_table(model, {2.4, 2.6, 0.0});
  mesh::Model slab;
  support::add_box(slab, {-7.0, -0.5, 0.0}, {6.0, 0.5, 8.0}, {"facade opposite", "slab"});
  slab = support::rotated(slab, {0, 0, 1}, -0.35);
  slab = support::rotated(slab, {1, 0.3, 0}, -0.2);
  support::append(model, support::moved(slab, {3.0, -7.5, 0.0}));
  return model;
}

lighting::Study louvred_study() {
  lighting::Study study = grey_study(louvred_room(), 0.5);
  const auto reflect = [&](const std::string& name, double reflectance) {
    for (lighting::SideMaterial* side : {&material(study, name).front, &material(study, name).back})
      side->reflectance = lighting::Spectrum{static_cast<float>(reflectance)};
  };
  reflect("floor", 0.25);
  reflect("ceiling", 0.8);
  reflect("wall", 0.6);
  reflect("slat", 0.7);
  reflect("facade opposite", 0.35);
  material(study, "glass").glazing = lighting::Glazing{.transmittance_normal = 0.70, .panes = 1};
  study.sky.type = lighting::Sky::Type::kCieOvercast;
  study.sky.ground_reflectance = 0.2;
  return study;
}

/// Twelve by twelve places in the middle of the cells of the plan, drawn in by 0.35 m or so from its walls.
std::vector<Point> places() {
  constexpr int kPerSide = 12;
  std::vector<Point> found;
  for (int i = 0; i < kPerSide; ++i) {
    for (int j = 0; j < kPerSide; ++j) {
      const double u = 0.08 + 0.84 * (i + 0.5) / kPerSide;
      const double v = 0.08 + 0.84 * (j + 0.5) / kPerSide;
      const auto at = [&](double Point::*c) {
        return (1 - u) * (1 - v) * kPlan[0].*c + u * (1 - v) * kPlan[1].*c + u * v * kPlan[2].*c +
               (1 - u) * v * kPlan[3].*c;
      };
      found.push_back({at(&Point::x), at(&Point::y), kWorkPlane_m});
    }
  }
  return found;
}

TEST(LouvredRoom, DaylightIsThatOfThePathTracerAsInTheOffice) {
  lighting::Study study = louvred_study();
  add_sensors(study, places(), {0, 0, 1});
  study.accuracy.target = 0.02;
  const lighting::Results results = answer(study);
  const Comparison c = compare(results.grids.at(0), traced_reference(study, 131'072));
  print("louvred room", c);
  EXPECT_TRUE(results.accuracy_met);
  EXPECT_LE(c.rms, 0.025);  // the noise of the path tracer included
  EXPECT_LE(std::abs(c.bias), 0.005);
  expect_honest("louvred room", c);
}

}  // namespace
}  // namespace clerestory::test
