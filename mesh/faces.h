// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mesh/clean.h"
#include "mesh/geometry.h"
#include "mesh/ids.h"
#include "mesh/limit_surface.h"

namespace clerestory::mesh {

/// One triangle of a planar face: vertex indices, counter-clockwise seen from the front.
struct Triangle {
  std::array<std::uint32_t, 3> vertices{};
  /// Bit k is set when the edge from vertices[k] to vertices[(k+1)%3] is a boundary of the face or a contact with another face.
  std::uint8_t constrained = 0;
  /// Regions of a face are what its boundary and contact lines leave connected (edge to edge). Counted per face from 0.
  std::uint32_t region = 0;
  /// Patches of a face are what these and the lines of discontinuity in its mesh leave connected. Counted per face from 0.
  std::uint32_t patch = 0;
};

/// Triangles of all faces: face f has triangles[starts[f]] … triangles[starts[f+1]-1].
struct Triangulation {
  std::vector<Point> vertices;  ///< local coordinates [m]
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> starts{0};

  [[nodiscard]] std::span<const Triangle> of(FaceId face) const {
    return std::span(triangles).subspan(starts[face.index()], starts[face.index() + 1] - starts[face.index()]);
  }
};

/// One planar face: coplanar, connected polygons of one material a side and one part, merged.
struct Face {
  Point origin;  ///< a point of the plane [m, local]
  Frame frame;   ///< w is the normal of the front
  double area_m2 = 0.0;
  MaterialId material;
  MaterialId back_material = {};  ///< where the back is of another material, of which it is the front; else not valid
  PartId part;
  /// Loops of vertex indices: outer boundaries counter-clockwise seen from the front, holes clockwise.
  std::vector<std::vector<std::uint32_t>> loops;
  /// Of a curved part: the facets that lie in this plane, by index into the curvature; empty where the face is flat.
  std::vector<std::uint32_t> facets;

  [[nodiscard]] MaterialId material_of(Side side) const {
    return side == Side::kBack && back_material.valid() ? back_material : material;
  }
};

/// All faces of a model. `shape` is the conforming triangulation with every contact imprinted: faces that touch share the
/// vertices of the line where they touch (exactly the same points), which is what makes rays against it watertight.
struct Faces {
  std::vector<Face> faces;
  Triangulation shape;
  Vector origin;  ///< model coordinates = local coordinates + origin [m]
  std::vector<std::string> material_names;
  std::vector<std::string> part_names;
  std::shared_ptr<const Curvature> curvature;  ///< of curved parts; may be null
  std::size_t contact_count = 0;               ///< contact segments imprinted

  [[nodiscard]] std::size_t count() const { return faces.size(); }
  /// The point of the limit surface that a point of a curved face stands for, both local; its normal is that of the front. Nothing for flat
  /// faces.
  [[nodiscard]] std::optional<LimitPoint> limit(FaceId face, const Point& point) const;
};

struct FaceOptions {
  /// Polygons belong to one plane when their vertices lie within this of it [m].
  double plane_tolerance_m = 2e-5;
  /// … and their normals differ by less than this [rad].
  double angle_tolerance_rad = 1e-4;
};

/// Merges coplanar, same-material, same-part connected polygons into faces with holes, closes contacts that miss each other by no more than
/// the surface's gap (mesh/near_contacts.h), finds where other faces touch or cross each face, and imprints those contacts (CGAL constrained Delaunay triangulation, exact predicates).
/// @param progress  hears which share is done; may be null
Faces build_faces(const CleanSurface& surface, const FaceOptions& options = {}, Progress* progress = nullptr);

/// A line that elements of a face must not cross [m, local]; off the face's plane by no more than rounding.
struct FaceLine {
  FaceId face;
  std::array<Point, 2> ends;
};

/// How the start mesh of the elements is made.
struct MeshOptions {
  double max_size_m = 4.0;            ///< longest edge of an element
  double min_angle_deg = 20.0;        ///< except next to input angles below 40 degrees
  std::span<const FaceLine> lines{};  ///< in any order of faces; in each face the weightiest first
  /// Where given, the longest edge of an element at a point of a face as well [m].
  std::function<double(FaceId, const Point&)> size_at{};
  std::span<const std::uint8_t> wanted{};  ///< [faces] zero: it gets no triangles; empty: all get some
  /// [faces] zero: it has as few triangles as its boundary, contacts and lines allow, at any angles; empty: all are refined.
  std::span<const std::uint8_t> refined{};
  /// Lines, or parts of lines, nearer to each other than this are one, the first of them; no line is displaced by more [m].
  double line_distance_m = 1e-3;
};

/// What the mesher could not do.
struct MeshReport {
  std::size_t triangles = 0;
  std::size_t small_angles = 0;        ///< triangles below the angle bound
  std::size_t small_input_angles = 0;  ///< of them, those at an input angle below 40 degrees
  double min_angle_deg = 180.0;
  std::size_t lines = 0;         ///< given
  std::size_t lines_merged = 0;  ///< of them, those that run along other lines, boundaries or contacts wholly
  double line_length_m = 0.0;    ///< in the mesh
  /// Faces whose lines are too fine: the lightest are left out, or all where the angle bound cannot be kept with them.
  std::size_t faces_with_fewer_lines = 0;
};

/// Constrained Delaunay triangulation, refined where that is asked for, of every face with its contacts and lines [Ruppert 1995; Shewchuk 2002], regions as in `shape`.
Triangulation mesh_faces(const Faces& faces, const MeshOptions& options, MeshReport* report = nullptr);

}  // namespace clerestory::mesh
