// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/faces.h"
#include "mesh/planar_region.h"
#include "mesh/t_junctions.h"
#include "mesh/vertex_index.h"

// Private to mesh/.
namespace clerestory::mesh {

/// From one vertex to another.
using DirectedEdge = std::array<std::uint32_t, 2>;

/// A face before its triangulation.
struct FaceDraft {
  PlaneCoordinates plane;
  MaterialId material;
  MaterialId back_material;
  PartId part;
  /// Closed; the face lies on the left, seen from the front. An edge stands twice where the face winds twice round its left.
  std::vector<DirectedEdge> boundary;
  /// Contacts with other faces; sorted, none twice, none on the boundary, once imprint_contacts() has run.
  std::vector<Edge> lines;
};

/// Faces that share vertices. No two vertices are closer than the tolerance.
struct FaceDrafts {
  explicit FaceDrafts(double plane_tolerance) : tolerance(plane_tolerance), vertices(plane_tolerance) {}

  /// The vertex for the end of a line, which lies on an edge of a face.
  std::uint32_t add_end(const Point& end);

  double tolerance;  ///< [m]
  VertexIndex vertices;
  std::vector<FaceDraft> faces;
  /// Ends of lines that were drawn to a vertex so far beside them that it lies on the edge no more for those who look at the vertex.
  struct DrawnEnd {
    Point end;
    std::uint32_t vertex = 0;
  };
  std::vector<DrawnEnd> drawn_ends;
};

/// The inside of a face in its plane.
PlanarRegion region_of(const FaceDrafts& drafts, const FaceDraft& face);

/// Appends the triangles of one face: constrained Delaunay, with its lines in it, regions numbered. Crossings of lines that are left get
/// vertices, which are added to the drafts.
/// @return the face's area [m²]
double triangulate_face(FaceDrafts& drafts, const FaceDraft& face, std::vector<Triangle>& triangles);

/// Finds where faces touch and cross each other and gives each of them those lines: edges of one that lie in the plane of another,
/// clipped to it, and the traces along which two faces cross. Then splits boundaries and lines of all faces at each other's
/// vertices and crossings, so that what coincides has the same vertices.
/// Costs O(n log n) where faces are near few others. Where after some rounds a crossing is left (lines closer to each other than
/// the tolerance, at angles near zero), the triangulation gives it a vertex that other faces do not share.
void imprint_contacts(FaceDrafts& drafts);

/// Adds to each face the lines where others touch or cross it; the first half of imprint_contacts().
void find_contacts(FaceDrafts& drafts);

/// Splits boundaries and lines of all faces at vertices on them, at ends of lines on them and where they cross in a face; the second
/// half.
void split_at_meetings(FaceDrafts& drafts);

}  // namespace clerestory::mesh
