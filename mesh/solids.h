// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/affine.h"
#include "mesh/geometry.h"

namespace clerestory::mesh {

/// A body by the triangles of its boundary, counter-clockwise seen from outside; or an open shell.
struct Solid {
  std::vector<Point> points;  ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;

  [[nodiscard]] bool empty() const { return triangles.empty(); }
};

/// The grid that corners are put on before solids are cut with each other [m]. Planes that a file means to be one then are one: else
/// exact arithmetic finds the 1e-16 m between them, and leaves a film there that closes an opening for light.
inline constexpr double kSolidGrid = 1e-6;

/// Enclosed volume [m³], negative for a body turned inside out; without meaning for an open shell.
double volume(const Solid& solid);
double surface_area(const Solid& solid);  ///< [m²]
Box box_of(const Solid& solid);
/// Whether every edge is walked as often one way as the other way.
bool is_closed(const Solid& solid);

/// Adds a flat face with holes: the loop of largest area is the outer one and tells the front, the others are holes or islands,
/// whichever way round they go (even-odd nesting). A face without area adds nothing.
void add_face(Solid& solid, std::span<const std::vector<Point>> loops);
/// The body between flat loops and the same loops moved, nested as in add_face(); outward whatever the loops' sense.
Solid prism(std::span<const std::vector<Point>> loops, const Vector& extrusion);
/// Two triangle soups as one.
void append(Solid& to, const Solid& from);
Solid transformed(Solid solid, const Affine& map);  ///< outward stays outward where the map mirrors
/// Corners on the grid, those at one place made one, triangles without area left out.
Solid snapped(const Solid& solid);
/// A closed body with outward triangles; open shells stay.
Solid outward(Solid solid);
/// What hangs together by common corners, as bodies of their own.
std::vector<Solid> connected_pieces(const Solid& solid);

/// The regularised booleans of closed, outward bodies that do not cross themselves. Both are snapped first, so both should be in a frame
/// in which their planes lie straight. Nothing where the bodies do not fulfil that. The result is a function of the shapes alone:
/// corners in lexicographic order, flat pieces by their Delaunay triangulation.
/// Source: CGAL, Polygon Mesh Processing, corefinement with exact constructions.
std::optional<Solid> difference(const Solid& body, const Solid& tool);
std::optional<Solid> intersection(const Solid& body, const Solid& tool);
std::optional<Solid> united(const Solid& body, const Solid& tool);
/// The part of an open shell that lies outside a closed, outward body.
std::optional<Solid> clipped(const Solid& shell, const Solid& tool);

}  // namespace clerestory::mesh
