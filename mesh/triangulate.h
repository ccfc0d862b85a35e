// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/planar.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Points and segments between them, in a plane.
struct PlanarGraph {
  std::vector<Point2> points;
  std::vector<std::array<std::uint32_t, 2>> segments;
};

struct PlanarTriangle {
  std::array<std::uint32_t, 3> vertices{};  ///< counter-clockwise
  std::uint8_t constrained = 0;             ///< bit k: the edge from vertices[k] to vertices[(k+1)%3] lies on a segment
  std::uint32_t component = 0;              ///< what segments leave connected, edge to edge, counted from 0
};

/// A triangulation of a PlanarGraph.
struct PlanarMesh {
  std::vector<Point2> points;  ///< those of the graph, then those added
  std::vector<PlanarTriangle> triangles;
  std::uint32_t component_count = 0;
};

/// A point inside each component: the centre of its largest triangle.
std::vector<Point2> component_middles(const PlanarMesh& mesh);

/// The constrained Delaunay triangulation of the convex hull. Exact predicates; points at the same place become the first of them.
/// Segments that cross get a common point, whose place is rounded.
PlanarMesh triangulate(const PlanarGraph& graph);

/// The triangulation of the inside of a boundary, with lines in it: triangulate(), without the components that the boundary does not
/// wind round, and without those that are no wider than a tolerance, which rounding of points along a line leaves.
/// @param boundary   directed segments between points of the graph, closed; they are segments of the graph too
/// @param min_width  [m]
PlanarMesh triangulate_inside(const PlanarGraph& graph, std::span<const std::array<std::uint32_t, 2>> boundary,
                              double min_width);

}  // namespace clerestory::mesh
