// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/limit_surface.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Triangles whose corners lie on the limit surface and which share them, so that there is no crack between patches of different
/// density.
struct LimitTessellation {
  struct Piece {
    std::array<std::uint32_t, 3> corners{};  ///< into points, wound as the cage's face
    PatchTriangle on_surface;
    std::uint32_t face = 0;    ///< of the cage
    double deviation_m = 0.0;  ///< of the limit surface from the triangle, the largest found
  };
  std::vector<Point> points;
  std::vector<Piece> pieces;  ///< by face, ascending
};

/// Triangles from which the limit surface is nowhere farther than the chord tolerance. The number of pieces of a patch in
/// each direction follows its normal curvatures, that of an edge the curve alone, so that neighbours agree; where samples of
/// the result are farther off than the tolerance the density grows. At most 256 pieces an edge.
/// Source: Filip, Magedson and Markot 1986 (from second derivatives to the number of pieces).
/// @param tolerance_m  [faces of the cage]
LimitTessellation tessellate(const ControlCage& cage, const LimitSurface& surface, std::span<const double> tolerance_m);

}  // namespace clerestory::mesh
