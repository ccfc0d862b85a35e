// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "mesh/faces.h"

/// What tests ask of surfaces.
namespace clerestory::support {

/// The index of a material by name; throws std::invalid_argument where there is none.
mesh::MaterialId material(const mesh::Faces& faces, std::string_view name);

/// The faces of a material, in order.
std::vector<mesh::FaceId> faces_of(const mesh::Faces& faces, std::string_view material);

/// Area of some triangles [m²].
double area_of(const mesh::Triangulation& mesh, std::span<const mesh::Triangle> triangles);

/// Regions of a face in a triangulation: one more than the largest number.
std::size_t region_count(const mesh::Triangulation& mesh, mesh::FaceId face);

/// Edges of the shape that the triangles of some parts do not walk equally often both ways, by vertex index. None for closed,
/// consistently wound surfaces whose triangles meet vertex to vertex.
std::size_t unbalanced_edges(const mesh::Faces& faces, std::string_view part);

/// What is wrong with a mesh of faces; all zero where it is conforming.
struct MeshFaults {
  std::size_t turned_or_empty = 0;   ///< triangles whose area seen from the front is not positive
  std::size_t edges_used_twice = 0;  ///< in one direction, by triangles of one face
  std::size_t open_edges = 0;        ///< of one triangle of the face alone, but not marked as constrained
  std::size_t loose_vertices = 0;    ///< vertices of a face inside of an edge of its mesh, within 1e-9 m
  double outline_error =
      0.0;  ///< largest difference of the length of a face's edges of one triangle from its loops', relative
  double area_error = 0.0;  ///< largest difference of the triangles' area from their face's, relative
};
MeshFaults mesh_faults(const mesh::Faces& faces, const mesh::Triangulation& mesh);

/// Vertices of the shape that lie on an edge of the shape, between its ends, within the distance [m]. O(n²).
std::size_t vertices_on_edges(const mesh::Faces& faces, double distance = 1.9e-5);

/// Triangles of a face that a segment cuts: both the parts of the triangle on either side are thicker than the distance [m] along the
/// segment's stretch within it.
std::size_t triangles_cut(const mesh::Triangulation& mesh, mesh::FaceId face, const mesh::Point& from,
                          const mesh::Point& to, double distance = 1e-6);

}  // namespace clerestory::support
