// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/validation/slit_rooms.h"

#include <cmath>
#include <utility>
#include <vector>

#include "tests/validation/studies.h"

namespace clerestory::test {

mesh::Vector turned(const mesh::Vector& v, const mesh::Vector& axis, double angle_rad) {
  const double c = std::cos(angle_rad);
  return c * v + std::sin(angle_rad) * cross(axis, v) + ((1.0 - c) * dot(axis, v)) * axis;
}

mesh::Point turned(const mesh::Point& p, const mesh::Vector& axis, double angle_rad) {
  return mesh::Point{} + turned(p - mesh::Point{}, axis, angle_rad);
}

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

const std::array<Traced, 18> kSlitReference{{
    {1.2006, 0.0054},
    {0.9512, 0.0048},
    {1.0496, 0.0050},
    {0.9747, 0.0048},
    {1.1985, 0.0054},
    {0.9511, 0.0048},
    {1.1350, 0.0053},
    {1.0210, 0.0050},
    {1.0743, 0.0051},
    {1.0434, 0.0050},
    {1.1307, 0.0053},
    {1.0164, 0.0049},
    {1.1319, 0.0053},
    {1.0236, 0.0050},
    {1.1755, 0.0054},
    {1.0918, 0.0052},
    {1.1312, 0.0054},
    {1.0250, 0.0050},
}};

}  // namespace clerestory::test
