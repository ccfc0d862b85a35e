// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "mesh/geometry.h"
#include "mesh/shafts.h"

namespace clerestory::lighting {

/// How much a point sees of a planar polygon past opaque faces, as a form factor.
struct SeenFactor {
  double factor = 0.0;
  bool exact = true;  ///< false: no more than that, as panes or a crowd stand before it
};

/// Clips the triangles of a polygon by what stands before them [mesh/seen_parts.h].
/// @param normal            unit, of the surface at the point
/// @param triangles         corners in turn, on the side of the polygon that counts counter-clockwise
/// @param triangles_normal  unit, of that side
SeenFactor seen_factor(const mesh::Shafts& shafts, const mesh::Point& at, const mesh::Vector& normal,
                       std::span<const std::array<mesh::Point, 3>> triangles, const mesh::Vector& triangles_normal);

}  // namespace clerestory::lighting
