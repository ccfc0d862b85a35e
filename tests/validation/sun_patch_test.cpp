// SPDX-License-Identifier: GPL-3.0-or-later
// Where the sun falls on the floor of the sample office, against the outline that its boxes and window openings give by themselves: the
// geometry stands here a second time, as make_office.py has it, and no ray tracer has a part in it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "io/study_file.h"
#include "lighting/discontinuities.h"
#include "lighting/scene.h"
#include "lighting/sun_light.h"
#include "lighting/sun_position.h"
#include "tests/support/places.h"

namespace clerestory::test {
namespace {

using mesh::Point;
using mesh::Vector;

constexpr double kNormalLux = 80'000.0;
constexpr double kMillimetre = 1e-3;

struct Box {
  Point low, high;
};

/// A hole of the south wall or a frame in the plane of this y.
struct Aperture {
  double y, x0, x1, z0, z1;
};

std::vector<Aperture> apertures(double x0, double x1) {
  constexpr double kSill = 0.9;
  constexpr double kHead = 2.4;
  constexpr double kFrame = 0.05;
  std::vector<Aperture> all;
  for (const double y : {-0.3, 0.0}) all.push_back({y, x0, x1, kSill, kHead});
  for (const double y : {-0.15, -0.09}) all.push_back({y, x0 + kFrame, x1 - kFrame, kSill + kFrame, kHead - kFrame});
  return all;
}

void add_legs(std::vector<Box>& boxes, double x0, double y0, double x1, double y1, double width, double height) {
  for (const double x : {x0, x1 - width})
    for (const double y : {y0, y1 - width}) boxes.push_back({{x, y, 0}, {x + width, y + width, height}});
}

std::vector<Box> furniture() {
  std::vector<Box> boxes{{{1.5, 3.98, 0}, {4.5, 4.02, 1.5}}, {{-9, -28, -0.3}, {15, -18, 8.7}}};
  // The boards on the sills.
  for (const double x : {0.6, 3.6}) boxes.push_back({{x, -0.09, 0.9}, {x + 1.8, 0.08, 0.93}});
  for (const auto& [x, y] : {std::array{0.9, 1.0}, {4.3, 1.0}, {0.9, 5.0}, {4.3, 5.0}}) {
    boxes.push_back({{x, y, 0.72}, {x + 0.8, y + 1.6, 0.75}});
    add_legs(boxes, x, y, x + 0.8, y + 1.6, 0.05, 0.72);
    const double seat = x < 3.0 ? 1.75 : 3.80;
    const double back = x < 3.0 ? 2.17 : 3.80;
    boxes.push_back({{seat, y + 0.55, 0.43}, {seat + 0.45, y + 1.0, 0.46}});
    boxes.push_back({{back, y + 0.55, 0.46}, {back + 0.03, y + 1.0, 0.90}});
    add_legs(boxes, seat + 0.02, y + 0.57, seat + 0.43, y + 0.98, 0.03, 0.43);
  }
  return boxes;
}

bool hits(const Box& box, const Point& from, const Vector& d) {
  double enter = 0.0;
  double leave = 1e9;
  const std::array<std::array<double, 4>, 3> axes{{{from.x, d.x, box.low.x, box.high.x},
                                                   {from.y, d.y, box.low.y, box.high.y},
                                                   {from.z, d.z, box.low.z, box.high.z}}};
  for (const auto& [at, step, low, high] : axes) {
    const double a = (low - at) / step;
    const double b = (high - at) / step;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

/// Whether the sun falls on a place of the floor, by geometry.
bool lit(double x, double y, const Vector& sun, const std::vector<Box>& boxes) {
  bool through = false;
  for (const auto& [x0, x1] : {std::array{0.6, 2.4}, {3.6, 5.4}}) {
    bool all = true;
    for (const Aperture& a : apertures(x0, x1)) {
      const double t = (a.y - y) / sun.y;
      const double at_x = x + t * sun.x;
      const double at_z = t * sun.z;
      if (t > 0.0) all = all && at_x > a.x0 && at_x < a.x1 && at_z > a.z0 && at_z < a.z1;
    }
    through = through || all;
  }
  if (!through) return false;
  for (const Box& box : boxes)
    if (hits(box, {x, y, 0}, sun)) return false;
  return true;
}

/// A place on the edge of the light, and the direction across which it was found, from dark to lit.
struct Edge {
  Point at;
  Vector to_light;
};

/// Edges along a line of places: where two neighbours differ, halved until a micrometre is left.
void find_edges(const Point& from, const Vector& step, int steps, const Vector& sun, const std::vector<Box>& boxes,
                std::vector<Edge>& edges) {
  const auto is_lit = [&](double s) {
    const Point p = from + s * step;
    return lit(p.x, p.y, sun, boxes);
  };
  for (int i = 0; i < steps; ++i) {
    double low = i;
    double high = i + 1.0;
    const bool before = is_lit(low);
    if (before == is_lit(high)) continue;
    while ((high - low) * norm(step) > 1e-6) {
      const double middle = 0.5 * (low + high);
      (is_lit(middle) == before ? low : high) = middle;
    }
    edges.push_back({from + low * step, (before ? -1.0 : 1.0) * normalized(step)});
  }
}

std::vector<Edge> outline(const Vector& sun) {
  const std::vector<Box> boxes = furniture();
  std::vector<Edge> edges;
  for (int i = 0; i < 60; ++i) {
    find_edges({0.013, 0.05 + 0.0731 * i, 0}, {0.01, 0, 0}, 597, sun, boxes, edges);
    find_edges({0.05 + 0.0973 * i, 0.013, 0}, {0, 0.01, 0}, 700, sun, boxes, edges);
  }
  return edges;
}

/// Whether geometry says the same of all places within a third of a millimetre: slivers have none.
bool is_clear(const Point& p, bool light, const Vector& sun, const std::vector<Box>& boxes) {
  for (const double dx : {-0.3, 0.0, 0.3})
    for (const double dy : {-0.3, 0.0, 0.3})
      if (lit(p.x + dx * kMillimetre, p.y + dy * kMillimetre, sun, boxes) != light) return false;
  return true;
}

double distance(const Point& p, const std::array<Point, 2>& ends) {
  const Vector along = ends[1] - ends[0];
  const double t = std::clamp(dot(p - ends[0], along) / dot(along, along), 0.0, 1.0);
  return norm(p - (ends[0] + t * along));
}

/// Whether something stands on the floor there: the edges of its foot are in the mesh as contacts, not as shadow lines.
bool is_foot(const Point& p, const std::vector<Box>& boxes) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Box& b) {
    return b.low.z == 0.0 && p.x > b.low.x - kMillimetre && p.x < b.high.x + kMillimetre &&
           p.y > b.low.y - kMillimetre && p.y < b.high.y + kMillimetre;
  });
}

/// How far the sun's lines on the floor are from places on the outline, the farthest [m].
double farthest_from_lines(const lighting::Scene& scene, const std::vector<Edge>& edges) {
  const lighting::SceneLines found = lighting::find_discontinuities(scene, {});
  double farthest = 0.0;
  const std::vector<Box> boxes = furniture();
  for (const Edge& edge : edges) {
    if (is_foot(edge.at, boxes)) continue;
    double nearest = 1e9;
    for (const mesh::DiscontinuityLine& line : found.lines) {
      if (line.order != 0 || found.sources.names[line.source] != "sun") continue;
      const Vector origin = scene.faces.origin;
      nearest = std::min(nearest, distance(edge.at, {line.ends[0] + origin, line.ends[1] + origin}));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

class SunPatch : public testing::TestWithParam<lighting::Moment> {};

TEST_P(SunPatch, HasItsOutlineToAMillimetre) {
  auto study = io::read_study(samples_dir() / "office" / "office.toml").study;
  const lighting::SunPosition position = lighting::sun_position({48.1, 11.6, 1.0}, GetParam());
  const Vector sun = lighting::direction_of(position.altitude_deg, position.azimuth_deg, 0.0);
  study.sky.sun = {.towards = sun, .normal_illuminance_lux = kNormalLux};
  const lighting::Scene scene = lighting::build_scene(study);
  const std::vector<Box> boxes = furniture();
  const std::vector<Edge> edges = outline(sun);
  ASSERT_GT(edges.size(), 50U);
  const auto by_program = [&](const Point& p) {
    const Point at = p - scene.faces.origin + Vector{0, 0, scene.rays->offset_m()};
    return lighting::sun_illuminance(scene, at, Vector{0, 0, 1}) > 0.3 * kNormalLux * sun.z;
  };
  std::size_t compared = 0;
  for (const Edge& edge : edges) {
    for (const bool light : {false, true}) {
      const Point p = edge.at + (light ? 1.0 : -1.0) * kMillimetre * edge.to_light;
      if (!is_clear(p, light, sun, boxes)) continue;
      ++compared;
      EXPECT_EQ(by_program(p), light) << p.x << " " << p.y;
    }
  }
  EXPECT_GT(compared, edges.size() / 4);

  const double farthest = farthest_from_lines(scene, edges);
  EXPECT_LT(farthest, kMillimetre);
  std::printf(
      "[ FIGURES  ] altitude %.2f, azimuth %.2f: %zu places on the outline, %zu of their sides compared, shadow lines "
      "within %.4f mm\n",
      position.altitude_deg, position.azimuth_deg, edges.size(), compared, 1e3 * farthest);
}

INSTANTIATE_TEST_SUITE_P(AtThreeMoments, SunPatch,
                         testing::Values(lighting::Moment{2026, 3, 21, 12.0}, lighting::Moment{2026, 9, 30, 14.5},
                                         lighting::Moment{2026, 6, 21, 10.5}));

}  // namespace
}  // namespace clerestory::test
