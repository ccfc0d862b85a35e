// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/geometry.h"
#include "mesh/subdivision_tags.h"

namespace clerestory::mesh {

/// The polygons that subdivision makes a limit surface of. Face f has the corners [face_starts[f], face_starts[f+1]).
struct ControlCage {
  SubdivisionScheme scheme = SubdivisionScheme::kCatmullClark;
  SubdivisionRules rules;
  std::vector<Point> points;  ///< [m]
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> face_starts{0};
  std::vector<SubdivisionTags::Crease> creases;       ///< edges by index into points
  std::vector<SubdivisionTags::Corner> sharp_points;  ///< by index into points
  std::vector<std::uint32_t> holes;                   ///< faces

  [[nodiscard]] std::size_t face_count() const { return face_starts.size() - 1; }
  [[nodiscard]] std::size_t face_size(std::size_t face) const { return face_starts[face + 1] - face_starts[face]; }
  [[nodiscard]] std::uint32_t corner(std::size_t face, std::size_t k) const {
    return corners[face_starts[face] + k % face_size(face)];
  }
};

/// A point of a limit surface.
struct LimitPoint {
  Point at;       ///< [m]
  Vector normal;  ///< unit length, to the side from which the cage's faces run counter-clockwise
};

/// Where on a limit surface a triangle of its tessellation has its corners.
struct PatchTriangle {
  std::uint32_t patch = 0;
  std::array<std::array<double, 2>, 3> at{};  ///< u, v of each corner
};

/// The limit surface of a control cage, by OpenSubdiv's Bfr; exact but for the innermost 2^-8 of a face around a vertex where other than
/// four (Loop: six) faces meet. A face of the regular size (Catmull-Clark four corners, Loop three) is one patch; another face
/// of n corners is n patches, patch k from corner k (0, 0) by way of the middle of edge k (1, 0) and the face's centre (1, 1) to the
/// middle of edge k-1 (0, 1). On one patch u runs along edge 0, v along the last edge. Immutable; may be read by many threads.
/// Source: Catmull and Clark 1978; Loop 1987; DeRose, Kass and Truong 1998 (creases); OpenSubdiv 3.5.
class LimitSurface {
 public:
  /// @param cage  faces with three or more different corners each, Loop's with three
  explicit LimitSurface(const ControlCage& cage);
  LimitSurface(LimitSurface&&) noexcept;
  LimitSurface& operator=(LimitSurface&&) noexcept;
  ~LimitSurface();

  struct Derivatives {
    Point at;
    Vector du, dv, duu, duv, dvv;  ///< [m], by the patch's u and v
  };

  /// Patches of a face: 0 for a hole or a face at a boundary without rule, else as above.
  [[nodiscard]] std::size_t patch_count(std::size_t face) const;
  [[nodiscard]] std::uint32_t first_patch(std::size_t face) const;
  /// Whether patches are triangles (0,0), (1,0), (0,1) and not squares.
  [[nodiscard]] bool has_triangles() const;
  [[nodiscard]] LimitPoint at(std::uint32_t patch, double u, double v) const;
  [[nodiscard]] Derivatives derivatives(std::uint32_t patch, double u, double v) const;
  /// Edges at which other than one or two faces meet or two run the same way, and vertices where several fans of faces meet: the
  /// first face at each. OpenSubdiv makes them sharp.
  [[nodiscard]] const std::vector<std::uint32_t>& non_manifold_edges() const;
  [[nodiscard]] const std::vector<std::uint32_t>& non_manifold_vertices() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clerestory::mesh
