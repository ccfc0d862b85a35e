// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reachable.h"

#include <gtest/gtest.h>

#include <numbers>

#include "mesh/clean.h"
#include "mesh/regions.h"
#include "tests/support/shapes.h"

namespace clerestory::mesh {
namespace {

Faces faces_of(const Model& model) { return build_faces(clean(model, {})); }

/// Whether all sides of faces of a part whose normals satisfy a condition are reachable, or none, or some.
enum class Found { kNoSuchSide, kNone, kSome, kAll };
template <class Wanted>
Found found(const Faces& faces, const std::vector<std::uint8_t>& sides, const std::string& part, Wanted wanted) {
  std::size_t all = 0;
  std::size_t reached = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const FaceSide fs = face_side(i);
    const Face& face = faces.faces[fs.face.index()];
    if (faces.part_names[face.part.index()] != part) continue;
    if (!wanted(face, side_normal(faces, fs.face, fs.side))) continue;
    ++all;
    reached += sides[i];
  }
  if (all == 0) return Found::kNoSuchSide;
  return reached == 0 ? Found::kNone : reached == all ? Found::kAll : Found::kSome;
}

/// A closed room of walls 0.2 m thick (a box in a box), with a hole in the outer and inner skin of the roof where asked.
Model thick_walled_room(bool skylight) {
  Model model;
  support::add_box(model, {-0.2, -0.2, -0.2}, {4.2, 4.2, 3.2}, {"wall", "outer"}, support::Fronts::kOutward);
  support::add_box(model, {0, 0, 0}, {4, 4, 3}, {"wall", "inner"}, support::Fronts::kInward);
  if (!skylight) return model;
  Model cut;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    std::vector<Point> outer;
    for (const std::uint32_t c : model.loop(p)) outer.push_back(model.vertices[c]);
    double lowest = outer.front().z;
    for (const Point& q : outer) lowest = std::min(lowest, q.z);
    std::vector<std::vector<Point>> holes;
    if (lowest > 1.0) holes.push_back({{1, 1, lowest}, {1, 2, lowest}, {2, 2, lowest}, {2, 1, lowest}});
    support::add_polygon(cut, outer, {"wall", model.part_names[model.polygon_part[p].index()]}, holes);
  }
  for (int i = 0; i < 4; ++i) {
    const std::array<std::array<double, 2>, 5> ring{{{1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}}};
    const auto& a = ring[static_cast<std::size_t>(i)];
    const auto& b = ring[static_cast<std::size_t>(i) + 1];
    support::add_quad(cut, {a[0], a[1], 3}, {b[0], b[1], 3}, {b[0], b[1], 3.2}, {a[0], a[1], 3.2}, {"wall", "reveal"});
  }
  return cut;
}

/// The box of thick_walled_room() is symmetric about the local origin.
bool inner_open_side(const Face& face, const Vector& normal) { return dot(normal, Point{} - face.origin) > 0.0; }
bool inner_solid_side(const Face& face, const Vector& normal) { return !inner_open_side(face, normal); }

TEST(Reachable, InAClosedDarkRoomOnlyTheOutsideIsReachable) {
  const Faces faces = faces_of(thick_walled_room(false));
  const Rays rays(faces);
  const auto sides = reachable_sides(faces, rays, {}, {});
  EXPECT_EQ(found(faces, sides, "inner", [](auto&&...) { return true; }), Found::kNone);
  EXPECT_EQ(found(faces, sides, "outer", inner_open_side), Found::kNone);
  EXPECT_EQ(found(faces, sides, "outer", inner_solid_side), Found::kAll);
}

TEST(Reachable, ASkylightLetsTheOutsideInButNotIntoTheWalls) {
  const Faces faces = faces_of(thick_walled_room(true));
  const Rays rays(faces);
  const auto sides = reachable_sides(faces, rays, {}, {});
  EXPECT_EQ(found(faces, sides, "inner", inner_open_side), Found::kAll);
  EXPECT_EQ(found(faces, sides, "inner", inner_solid_side), Found::kNone);
  EXPECT_EQ(found(faces, sides, "outer", inner_open_side), Found::kNone);
}

TEST(Reachable, APointSourceReachesItsRoomAndNotTheNextOne) {
  const Faces faces = faces_of(support::two_rooms_with_thin_wall({.thickness_m = 0.1, .rotation_rad = 0.31}));
  const Rays rays(faces);
  const Point lamp =
      Point{1.2 * std::cos(0.31) - 2.0 * std::sin(0.31), 1.2 * std::sin(0.31) + 2.0 * std::cos(0.31), 2.0} -
      faces.origin;
  const std::vector<Point> lamps{lamp};
  const std::vector<std::uint8_t> none(2 * faces.count(), 0);
  const auto sides = reachable_sides(faces, rays, none, lamps);
  // The room's outside is reachable through the outside, its insides are one face for both rooms: regions tell them apart.
  const auto triangles = reachable_triangles(faces, rays, sides);
  std::size_t lit = 0;
  std::size_t dark = 0;
  for (std::uint32_t t = 0; t < faces.shape.triangles.size(); ++t) {
    const auto [a, b, c] = corners(faces, t);
    const Point centre = a + (1.0 / 3.0) * ((b - a) + (c - a)) + faces.origin;
    const double x = centre.x * std::cos(0.31) + centre.y * std::sin(0.31);
    const Vector normal = cross(b - a, c - a);
    if (std::abs(normalized(normal).z) < 0.9 || centre.z > 1.0) continue;
    const auto up = static_cast<std::size_t>(normal.z > 0.0 ? Side::kFront : Side::kBack);
    if (x < 2.95) {
      EXPECT_EQ(triangles[2 * t + up], 1) << "floor of the lit room at x = " << x;
      ++lit;
    } else if (x > 3.05) {
      EXPECT_EQ(triangles[2 * t + up], 0) << "floor of the dark room at x = " << x;
      ++dark;
    } else {
      EXPECT_EQ(triangles[2 * t + up], 0) << "floor inside the wall";
    }
  }
  EXPECT_GT(lit, 0U);
  EXPECT_GT(dark, 0U);
}

TEST(Reachable, LegsWithoutFeetAreDarkInside) {
  const Faces faces = faces_of(support::table_on_floor());
  const Rays rays(faces);
  const auto sides = reachable_sides(faces, rays, {}, {});
  const auto is_leg = [&](const Face& face) { return faces.material_names[face.material.index()] == "metal"; };
  std::size_t insides = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const FaceSide fs = face_side(i);
    if (!is_leg(faces.faces[fs.face.index()])) continue;
    const Vector normal = side_normal(faces, fs.face, fs.side);
    const auto [a, b, c] = corners(faces, faces.shape.starts[fs.face.index()]);
    const Point local = a + (1.0 / 3.0) * ((b - a) + (c - a)) + 0.02 * normal + faces.origin;
    const auto within = [](double v, double low) { return v > low && v < low + 0.05; };
    bool inside = false;
    for (const double x : {1.2, 2.75}) {
      for (const double y : {1.6, 2.35}) inside |= within(local.x, x) && within(local.y, y);
    }
    if (inside) {
      ++insides;
      EXPECT_EQ(sides[i], 0) << local.x << ' ' << local.y;
    }
  }
  EXPECT_GT(insides, 0U);
  const auto upward = [](const Face&, const Vector& normal) { return normal.z > 0.9; };
  EXPECT_EQ(found(faces, sides, "floor", upward), Found::kAll);
}

TEST(Reachable, SidesThatShineAndWhatTheySeeAreReachable) {
  const Faces faces = faces_of(support::box_room(3, 4, 3));
  const Rays rays(faces);
  const auto dark = reachable_sides(faces, rays, {}, {});
  const auto any_inside = [&](const std::vector<std::uint8_t>& sides) {
    return found(faces, sides, faces.part_names.front(), [&](const Face& face, const Vector& normal) {
      return dot(normal, (Point{1.5, 2, 1.5} - faces.origin) - face.origin) > 0.0;
    });
  };
  EXPECT_EQ(any_inside(dark), Found::kNone);
  std::vector<std::uint8_t> seeds(2 * faces.count(), 0);
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (faces.material_names[faces.faces[f].material.index()] == "ceiling") seeds[2 * f] = 1;
  }
  EXPECT_EQ(any_inside(reachable_sides(faces, rays, seeds, {})), Found::kAll);
}

TEST(Reachable, ASmallLampInAClosedRoomLightsAllOfIt) {
  Model model = thick_walled_room(false);
  support::add_box(model, {1.0, 1.0, 2.0}, {1.03, 1.03, 2.03}, {"lamp", "lamp"}, support::Fronts::kOutward);
  const Faces faces = faces_of(model);
  const Rays rays(faces);
  std::vector<std::uint8_t> seeds(2 * faces.count(), 0);
  for (std::size_t f = 0; f < faces.count(); ++f) {
    if (faces.material_names[faces.faces[f].material.index()] == "lamp") seeds[2 * f] = 1;
  }
  const auto sides = reachable_sides(faces, rays, seeds, {});
  EXPECT_EQ(found(faces, sides, "inner", inner_open_side), Found::kAll);
  EXPECT_EQ(found(faces, sides, "inner", inner_solid_side), Found::kNone);
}

TEST(Reachable, GlassLetsTheOutsideIn) {
  Model model = support::box_room(3, 4, 3);
  Model windowed;
  for (std::size_t p = 0; p < model.polygon_count(); ++p) {
    std::vector<Point> outer;
    for (const std::uint32_t c : model.loop(p)) outer.push_back(model.vertices[c]);
    const bool ceiling = model.material_names[model.polygon_material[p].index()] == "ceiling";
    support::add_polygon(windowed, outer, {ceiling ? "glass" : "wall", "room"});
  }
  const Faces faces = faces_of(windowed);
  std::vector<std::uint8_t> passable(faces.count(), 0);
  for (std::size_t f = 0; f < faces.count(); ++f) {
    passable[f] = faces.material_names[faces.faces[f].material.index()] == "glass" ? 1 : 0;
  }
  const auto all_reached = [&](const Rays& rays) {
    const auto sides = reachable_sides(faces, rays, {}, {});
    return std::ranges::all_of(sides, [](std::uint8_t s) { return s == 1; });
  };
  EXPECT_TRUE(all_reached(Rays(faces, passable)));
  EXPECT_FALSE(all_reached(Rays(faces)));
}

/// Two rooms of faces of their own, named "lit" and "dark", with a lamp in the one, and a wall between them that ends above the floors.
Model rooms_joined_by_a_slit(double width_m) {
  Model model;
  const auto room = [&](double from, double to, const char* name) {
    const support::Names names{name, name};
    for (const double z : {0.0, 3.0})
      support::add_quad(model, {from, 0, z}, {to, 0, z}, {to, 4, z}, {from, 4, z}, names);
    for (const double y : {0.0, 4.0})
      support::add_quad(model, {from, y, 0}, {to, y, 0}, {to, y, 3}, {from, y, 3}, names);
  };
  room(0, 3, "lit");
  room(3, 6, "dark");
  for (const double x : {0.0, 6.0}) support::add_quad(model, {x, 0, 0}, {x, 4, 0}, {x, 4, 3}, {x, 0, 3});
  support::add_quad(model, {3, 0, width_m}, {3, 4, width_m}, {3, 4, 3}, {3, 0, 3});
  support::add_quad(model, {1, 1.5, 2.9}, {1, 2, 2.9}, {1.5, 2, 2.9}, {1.5, 1.5, 2.9}, {"lamp", "lamp"});
  return model;
}

TEST(Reachable, AFloorOfItsOwnBehindASlitIsReached) {
  for (const double width_m : {0.05, 0.01}) {
    CleanOptions options;
    options.gap_m = 0.0;
    const Faces faces = build_faces(clean(rooms_joined_by_a_slit(width_m), options));
    std::vector<std::uint8_t> seeds(2 * faces.count(), 0);
    for (std::size_t f = 0; f < faces.count(); ++f) {
      if (faces.material_names[faces.faces[f].material.index()] == "lamp") seeds[2 * f] = 1;
    }
    const auto sides = reachable_sides(faces, Rays(faces), seeds, {});
    const auto inwards = [](const Face& face, const Vector& normal) {
      return dot(normal, Point{} - face.origin) > 0.0;
    };
    EXPECT_EQ(found(faces, sides, "lit", inwards), Found::kAll) << width_m;
    EXPECT_EQ(found(faces, sides, "dark", inwards), Found::kAll) << width_m;
  }
}

}  // namespace
}  // namespace clerestory::mesh
