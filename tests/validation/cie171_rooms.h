// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "mesh/model.h"
#include "tests/support/shapes.h"

/// The room of CIE 171:2006: 0 ≤ x ≤ 4, 0 ≤ y ≤ 4, 0 ≤ z ≤ 3 m, and the points in it where values are published.
namespace clerestory::test::cie171 {

/// A side of the room in coordinates of its own: u and v along its edges, u × v into the room.
struct RoomSide {
  std::string material;
  mesh::Point corner;
  mesh::Vector u;
  mesh::Vector v;
  double width_m;
  double height_m;

  [[nodiscard]] std::vector<mesh::Point> rectangle(double u0, double v0, double u1, double v1) const {
    return {corner + u0 * u + v0 * v, corner + u1 * u + v0 * v, corner + u1 * u + v1 * v, corner + u0 * u + v1 * v};
  }
};

inline std::vector<RoomSide> room_sides() {
  return {{"floor", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 4, 4},  {"ceiling", {0, 4, 3}, {1, 0, 0}, {0, -1, 0}, 4, 4},
          {"south", {4, 0, 0}, {-1, 0, 0}, {0, 0, 1}, 4, 3}, {"north", {0, 4, 0}, {1, 0, 0}, {0, 0, 1}, 4, 3},
          {"west", {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 4, 3},   {"east", {4, 4, 0}, {0, -1, 0}, {0, 0, 1}, 4, 3}};
}

/// A rectangle cut out of a side and filled with another material; a hole where the name is empty.
struct Cutout {
  std::string side;
  std::string material;
  double u0, v0, u1, v1;  ///< [m] in the side's coordinates; all of the side leaves nothing of it
};

inline mesh::Model room(const std::vector<Cutout>& cutouts = {}) {
  mesh::Model model;
  for (const RoomSide& side : room_sides()) {
    std::vector<std::vector<mesh::Point>> holes;
    bool anything_left = true;
    for (const Cutout& cut : cutouts) {
      if (cut.side != side.material) continue;
      const auto outline = side.rectangle(cut.u0, cut.v0, cut.u1, cut.v1);
      if (!cut.material.empty()) support::add_polygon(model, outline, {.material = cut.material, .part = cut.material});
      holes.push_back({outline.rbegin(), outline.rend()});
      if (cut.u1 - cut.u0 == side.width_m && cut.v1 - cut.v0 == side.height_m) anything_left = false;
    }
    if (!anything_left) continue;
    support::add_polygon(model, side.rectangle(0, 0, side.width_m, side.height_m),
                         {.material = side.material, .part = "room"}, holes);
  }
  return model;
}

/// A–F: on the wall at this y, from the top down.
inline std::vector<mesh::Point> wall_points(double y) {
  return {{2, y, 2.75}, {2, y, 2.25}, {2, y, 1.75}, {2, y, 1.25}, {2, y, 0.75}, {2, y, 0.25}};
}

/// G–N: on the floor (z = 0) or the ceiling (z = 3), y = 0.25 first.
inline std::vector<mesh::Point> row_points(double z) {
  return {{2, 0.25, z}, {2, 0.75, z}, {2, 1.25, z}, {2, 1.75, z},
          {2, 2.25, z}, {2, 2.75, z}, {2, 3.25, z}, {2, 3.75, z}};
}

}  // namespace clerestory::test::cie171
