// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/box_tree.h"
#include "mesh/critical_surfaces.h"
#include "mesh/faces.h"
#include "mesh/ids.h"
#include "mesh/silhouettes.h"

// Private to mesh/.
namespace clerestory::mesh {

/// A part of a critical surface that light reaches: lines from the source that touch the occluder between near[0] and near[1] end on
/// a face between far[0] and far[1].
struct TracedPiece {
  std::array<Point, 2> near;  ///< [m]; of an EV surface both are its pivot
  std::array<Point, 2> far;   ///< [m]
  FaceId face;
  Side side = Side::kFront;
};

/// Follows critical surfaces through a scene. What is visible in the plane of a surface is found exactly, by a sweep over the
/// segments in which it cuts the opaque triangles [Heckbert 1992].
class WedgeTracer {
 public:
  /// @param passable  [faces] non-zero for faces that light passes; empty: all are opaque. Kept by reference, as the others.
  WedgeTracer(const Faces& faces, std::span<const std::uint8_t> passable, const Occluders& occluders);

  /// Appends the visible parts. O(log n + k log k) for k triangles in the surface's way. Thread-safe.
  void trace(const Wedge& wedge, std::vector<TracedPiece>& pieces) const;

 private:
  const Faces& faces_;
  const Occluders& occluders_;
  std::vector<std::uint32_t> triangles_;  ///< of the shape, opaque
  std::vector<FaceId> face_of_;           ///< [triangles_]
  BoxTree tree_;
};

}  // namespace clerestory::mesh
