// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "mesh/triangulate.h"

// Private to mesh/.
namespace clerestory::mesh {

/// What refine() aims at.
struct RefineOptions {
  double max_edge = 4.0;  ///< [m]
  /// Where given, the longest edge of a triangle with its middle there as well [m].
  std::function<double(const Point2&)> max_edge_at{};
  double min_angle_deg = 20.0;   ///< at most 20.7 for refinement to end for sure, small input angles apart
  std::size_t max_vertices = 0;  ///< beyond so many the refinement gives up
};

/// Constrained Delaunay refinement of a conforming triangulation [Ruppert 1995; Shewchuk 2002]: points are added on its
/// constrained edges and inside until the options hold. Components keep their numbers, the graph's points theirs.
/// @param mesh  a triangulation as triangulate_inside() gives it; every point belongs to a triangle
/// @return nothing where max_vertices did not suffice, where the mesh has edges of no length, or where rounding would turn a triangle over
std::optional<PlanarMesh> refine(const PlanarMesh& mesh, const RefineOptions& options);

}  // namespace clerestory::mesh
