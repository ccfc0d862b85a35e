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
    {1.1999, 0.0076},
    {0.9644, 0.0069},
    {1.0455, 0.0071},
    {0.9787, 0.0069},
    {1.2096, 0.0077},
    {0.9501, 0.0067},
    {1.1324, 0.0075},
    {1.0131, 0.0070},
    {1.0751, 0.0075},
    {1.0422, 0.0073},
    {1.1335, 0.0075},
    {1.0186, 0.0070},
    {1.1371, 0.0076},
    {1.0265, 0.0070},
    {1.1823, 0.0077},
    {1.0979, 0.0075},
    {1.1241, 0.0076},
    {1.0331, 0.0072},
}};

}  // namespace clerestory::test
