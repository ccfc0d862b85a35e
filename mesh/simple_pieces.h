// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/triangulate.h"

// Private to mesh/.
namespace clerestory::mesh {

/// The triangles of a planar mesh joined to polygons whose outlines do not touch themselves, so that none has a hole; counter-clockwise.
/// Triangles are joined across the edge over which they are least high first: what is narrow hangs together with what lies beside it.
/// Not the fewest such polygons. Cost O(n log n).
std::vector<std::vector<std::uint32_t>> simple_pieces(const PlanarMesh& mesh);

}  // namespace clerestory::mesh
