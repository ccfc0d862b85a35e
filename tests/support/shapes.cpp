// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace clerestory::support {

using mesh::MaterialId;
using mesh::Model;
using mesh::PartId;
using mesh::Point;
using mesh::Vector;

namespace {

std::size_t index_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

void add_loop(Model& model, std::span<const Point> points) {
  std::vector<std::uint32_t> corners;
  for (const Point& p : points) {
    corners.push_back(static_cast<std::uint32_t>(model.vertices.size()));
    model.vertices.push_back(p);
  }
  model.add_loop(corners);
}

std::vector<Point> at_height(std::span<const Point> outline, double z) {
  std::vector<Point> points(outline.begin(), outline.end());
  for (Point& p : points) p.z = z;
  return points;
}

/// A closed room over an outline, with the material names that people use.
Model room_over(std::span<const Point> outline, double height_m) {
  Model model;
  add_polygon(model, at_height(outline, 0.0), {"floor", "room"});
  std::vector<Point> ceiling = at_height(outline, height_m);
  std::reverse(ceiling.begin(), ceiling.end());
  add_polygon(model, ceiling, {"ceiling", "room"});
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point& a = outline[i];
    const Point& b = outline[(i + 1) % outline.size()];
    add_quad(model, {b.x, b.y, 0}, {a.x, a.y, 0}, {a.x, a.y, height_m}, {b.x, b.y, height_m}, {"wall", "room"});
  }
  return model;
}

void add_leg(Model& model, const Point& low, double size_m, double top_m, const Names& names) {
  const double x = low.x;
  const double y = low.y;
  const double z = low.z;
  const double s = size_m;
  add_quad(model, {x, y, z}, {x + s, y, z}, {x + s, y, top_m}, {x, y, top_m}, names);
  add_quad(model, {x + s, y, z}, {x + s, y + s, z}, {x + s, y + s, top_m}, {x + s, y, top_m}, names);
  add_quad(model, {x + s, y + s, z}, {x, y + s, z}, {x, y + s, top_m}, {x + s, y + s, top_m}, names);
  add_quad(model, {x, y + s, z}, {x, y, z}, {x, y, top_m}, {x, y + s, top_m}, names);
}

}  // namespace

void add_polygon(Model& model, std::span<const Point> outer, const Names& names,
                 const std::vector<std::vector<Point>>& holes) {
  model.begin_polygon(MaterialId(index_of(model.material_names, names.material)),
                      PartId(index_of(model.part_names, names.part)));
  add_loop(model, outer);
  for (const std::vector<Point>& hole : holes) add_loop(model, hole);
}

void add_polygon(Model& model, std::initializer_list<Point> outer, const Names& names,
                 const std::vector<std::vector<Point>>& holes) {
  add_polygon(model, std::span(outer.begin(), outer.size()), names, holes);
}

void add_quad(Model& model, const Point& a, const Point& b, const Point& c, const Point& d, const Names& names) {
  add_polygon(model, {a, b, c, d}, names);
}

void add_triangle(Model& model, const Point& a, const Point& b, const Point& c, const Names& names) {
  add_polygon(model, {a, b, c}, names);
}

void add_box(Model& model, const Point& low, const Point& high, const Names& names, Fronts fronts) {
  const std::vector<Point> outline{{low.x, low.y, 0}, {high.x, low.y, 0}, {high.x, high.y, 0}, {low.x, high.y, 0}};
  add_prism(model, outline, low.z, high.z, names, fronts);
}

void add_prism(Model& model, std::span<const Point> outline, double low, double high, const Names& names,
               Fronts fronts) {
  const auto add = [&](std::vector<Point> outward) {
    if (fronts == Fronts::kInward) std::reverse(outward.begin(), outward.end());
    add_polygon(model, outward, names);
  };
  std::vector<Point> bottom = at_height(outline, low);
  std::reverse(bottom.begin(), bottom.end());
  add(bottom);
  add(at_height(outline, high));
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point& a = outline[i];
    const Point& b = outline[(i + 1) % outline.size()];
    add({{a.x, a.y, low}, {b.x, b.y, low}, {b.x, b.y, high}, {a.x, a.y, high}});
  }
}

void add_globe(Model& model, const Point& centre, double radius_m, int meridians, int parallels, const Names& names) {
  const auto at = [&](int meridian, int parallel) {
    const double polar = std::numbers::pi * parallel / parallels;
    const double azimuth = 2.0 * std::numbers::pi * (meridian % meridians) / meridians;
    return centre + radius_m * mesh::Vector{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                                            std::cos(polar)};
  };
  for (int p = 0; p < parallels; ++p) {
    for (int m = 0; m < meridians; ++m) {
      if (p == 0)
        add_triangle(model, at(0, 0), at(m, 1), at(m + 1, 1), names);
      else if (p + 1 == parallels)
        add_triangle(model, at(0, parallels), at(m + 1, p), at(m, p), names);
      else
        add_quad(model, at(m, p), at(m, p + 1), at(m + 1, p + 1), at(m + 1, p), names);
    }
  }
}

void append(Model& model, const Model& other) {
  for (std::size_t p = 0; p < other.polygon_count(); ++p) {
    const Names names{other.material_names[other.polygon_material[p].index()],
                      other.part_names[other.polygon_part[p].index()]};
    std::vector<std::vector<Point>> loops(other.loop_count(p));
    for (std::size_t l = 0; l < loops.size(); ++l) {
      for (const std::uint32_t corner : other.loop(p, l)) loops[l].push_back(other.vertices[corner]);
    }
    const std::vector<Point> outer = loops.front();
    loops.erase(loops.begin());
    add_polygon(model, outer, names, loops);
  }
}

// Rodrigues' formula.
Model rotated(Model model, const Vector& axis, double angle_rad) {
  const Vector k = mesh::normalized(axis);
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  for (Point& p : model.vertices) {
    const Vector v{p.x, p.y, p.z};
    const Vector turned = c * v + s * mesh::cross(k, v) + ((1.0 - c) * mesh::dot(k, v)) * k;
    p = {turned.x, turned.y, turned.z};
  }
  return model;
}

Model moved(Model model, const Vector& by) {
  for (Point& p : model.vertices) p = p + by;
  return model;
}

Model box_room(double width_m, double depth_m, double height_m) {
  const std::vector<Point> outline{{0, 0, 0}, {width_m, 0, 0}, {width_m, depth_m, 0}, {0, depth_m, 0}};
  return room_over(outline, height_m);
}

Model l_room() {
  const std::vector<Point> outline{{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}};
  return room_over(outline, 3.0);
}

Model shelf() {
  Model model;
  add_quad(model, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {"floor", "floor"});
  add_quad(model, {0.5, 2, 0}, {1.5, 2, 0}, {1.5, 2, 1.5}, {0.5, 2, 1.5}, {"wood", "shelf"});
  for (const double z : {0.5, 1.0}) {
    add_quad(model, {0.5, 1.7, z}, {1.5, 1.7, z}, {1.5, 2, z}, {0.5, 2, z}, {"wood", "shelf"});
  }
  return model;
}

Model non_manifold_fan() {
  Model model;
  const double fifth = 2.0 * std::acos(-1.0) / 5.0;
  for (int i = 0; i < 5; ++i) {
    const double x = std::cos(i * fifth);
    const double y = std::sin(i * fifth);
    add_quad(model, {0, 0, 0}, {x, y, 0}, {x, y, 1}, {0, 0, 1}, {"wall", "fan"});
  }
  return model;
}

Model two_rooms_with_thin_wall(const ThinWall& wall) {
  Model model = box_room(6.0, 4.0, 3.0);
  const Names names{"partition", "partition"};
  const double half = 0.5 * wall.thickness_m;
  const double left = 3.0 - half;
  const double right = 3.0 + half;
  const double foot = wall.short_m;
  add_quad(model, {left, 0, foot}, {left, 0, 3}, {left, 4, 3}, {left, 4, foot}, names);
  if (half > 0.0) add_quad(model, {right, 0, foot}, {right, 4, foot}, {right, 4, 3}, {right, 0, 3}, names);
  return wall.rotation_rad == 0.0 ? model : rotated(std::move(model), wall.axis, wall.rotation_rad);
}

Model facing_squares(double distance_m) {
  Model model;
  add_quad(model, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {"lower", "lower"});
  const double z = distance_m;
  add_quad(model, {0, 0, z}, {0, 1, z}, {1, 1, z}, {1, 0, z}, {"upper", "upper"});
  return model;
}

void add_table(Model& model, const Point& corner, const std::string& part) {
  const double x = corner.x;
  const double y = corner.y;
  const double z = corner.z;
  add_box(model, {x, y, z + 0.72}, {x + 1.6, y + 0.8, z + 0.75}, {"wood", part});
  for (const double dx : {0.0, 1.55}) {
    for (const double dy : {0.0, 0.75}) add_leg(model, {x + dx, y + dy, z}, 0.05, z + 0.72, {"metal", part});
  }
}

Model table_on_floor() {
  Model model;
  add_quad(model, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {"floor", "floor"});
  add_table(model, {1.2, 1.6, 0.0});
  return model;
}

Model wall_with_opening() {
  Model model;
  const Names wall{"wall", "wall"};
  const std::vector<Point> hole_front{{1, 0, 0.9}, {1, 0, 2.5}, {3, 0, 2.5}, {3, 0, 0.9}};
  const std::vector<Point> hole_back{{1, 0.3, 0.9}, {3, 0.3, 0.9}, {3, 0.3, 2.5}, {1, 0.3, 2.5}};
  add_polygon(model, {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}}, wall, {hole_front});
  add_polygon(model, {{0, 0.3, 0}, {0, 0.3, 3}, {4, 0.3, 3}, {4, 0.3, 0}}, wall, {hole_back});
  for (std::size_t i = 0; i < 4; ++i) {
    const Point& a = hole_front[i];
    const Point& b = hole_front[(i + 1) % 4];
    add_quad(model, a, b, {b.x, 0.3, b.z}, {a.x, 0.3, a.z}, wall);
  }
  return model;
}

Model glass_box_in_wall(double glass_thickness_m) {
  Model model = wall_with_opening();
  const double half = 0.5 * glass_thickness_m;
  add_box(model, {1, 0.15 - half, 0.9}, {3, 0.15 + half, 2.5}, {"glass", "window"});
  return model;
}

Model square_with_hole() {
  Model model;
  add_polygon(model, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {"floor", "floor"},
              {{{1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}}});
  return model;
}

Model square_with_bridged_hole() {
  Model model;
  add_polygon(
      model,
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}},
      {"floor", "floor"});
  return model;
}

}  // namespace clerestory::support
