// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "mesh/model.h"

/// Tiny named models for tests. Metres, z up. No vertex is shared between polygons, as in many exports.
namespace clerestory::support {

/// Names that a polygon gets; a name that is new to the model is added to it.
struct Names {
  std::string material = "wall";
  std::string part = "room";
};

/// Whether the fronts of a closed shape look into it or out of it.
enum class Fronts { kInward, kOutward };

/// Appends one polygon; its front is the side from which the outer loop is counter-clockwise.
void add_polygon(mesh::Model& model, std::span<const mesh::Point> outer, const Names& names = {},
                 const std::vector<std::vector<mesh::Point>>& holes = {});
void add_polygon(mesh::Model& model, std::initializer_list<mesh::Point> outer, const Names& names = {},
                 const std::vector<std::vector<mesh::Point>>& holes = {});
void add_quad(mesh::Model& model, const mesh::Point& a, const mesh::Point& b, const mesh::Point& c,
              const mesh::Point& d, const Names& names = {});
void add_triangle(mesh::Model& model, const mesh::Point& a, const mesh::Point& b, const mesh::Point& c,
                  const Names& names = {});
/// Appends the six quads of an axis-aligned box.
void add_box(mesh::Model& model, const mesh::Point& low, const mesh::Point& high, const Names& names = {},
             Fronts fronts = Fronts::kOutward);
/// Appends a prism over a counter-clockwise outline in the xy plane, from z = low to z = high.
void add_prism(mesh::Model& model, std::span<const mesh::Point> outline, double low, double high,
               const Names& names = {}, Fronts fronts = Fronts::kOutward);
/// Appends a sphere of flat facets between meridians and parallels, as CAD programs export it: triangles at the poles, else quads.
void add_globe(mesh::Model& model, const mesh::Point& centre, double radius_m, int meridians, int parallels,
               const Names& names = {});
/// Appends all polygons of another model, names matched.
void append(mesh::Model& model, const mesh::Model& other);

/// The model turned about an axis through the origin (right-handed), or displaced.
mesh::Model rotated(mesh::Model model, const mesh::Vector& axis, double angle_rad);
mesh::Model moved(mesh::Model model, const mesh::Vector& by);

/// A closed room [0,w] × [0,d] × [0,h], fronts inward; materials floor, ceiling, wall.
mesh::Model box_room(double width_m, double depth_m, double height_m);

/// A closed room over an L of legs 4 m and width 2 m (area 12 m²), 3 m high, fronts inward; materials as box_room.
mesh::Model l_room();

/// A floor of 2 m × 2 m at z = 0 with two zero-thickness shelf boards of 1 m × 0.3 m at z = 0.5 and z = 1 before a back board.
mesh::Model shelf();

/// Five quads of 1 m × 1 m that share one vertical edge at the z axis.
mesh::Model non_manifold_fan();

struct ThinWall {
  double thickness_m = 0.0;   ///< 0: one sheet; else a slab with two sides and no foot or top
  double rotation_rad = 0.0;  ///< of the whole model, about the axis below
  mesh::Vector axis{0.0, 0.0, 1.0};
  double short_m = 0.0;  ///< so far above the floor it ends
};
/// Two closed rooms of 3 m × 4 m × 3 m side by side along x: one floor polygon, one ceiling polygon and one front and back wall
/// polygon for both, divided at x = 3 by a wall (material "partition") that ends on them without a common vertex.
mesh::Model two_rooms_with_thin_wall(const ThinWall& wall = {});

/// Two unit squares, parallel, this far apart along z, fronts facing; materials lower, upper.
mesh::Model facing_squares(double distance_m = 1.0);

/// A floor of 4 m × 4 m at z = 0 (material floor) with a table of 1.6 m × 0.8 m × 0.75 m on it (materials wood, metal): a top of
/// 3 cm and four legs of 5 cm without faces at their feet and heads, as CAD tools leave them.
mesh::Model table_on_floor();
/// Appends that table with the corner of its top nearest to the origin at this point of the floor.
void add_table(mesh::Model& model, const mesh::Point& corner, const std::string& part = "table");

/// A wall of 4 m × 3 m × 0.3 m along x with an opening of 2 m × 1.6 m and reveals.
mesh::Model wall_with_opening();
/// The same with, in mid-wall, a glass box (material glass) of this thickness that fills the opening.
mesh::Model glass_box_in_wall(double glass_thickness_m = 0.024);

/// A square of 4 m in the xy plane with a square hole of 2 m in its middle (area 12 m²), front up: as a polygon with a hole loop,
/// and as one loop that reaches the hole by a bridge walked twice.
mesh::Model square_with_hole();
mesh::Model square_with_bridged_hole();

}  // namespace clerestory::support
