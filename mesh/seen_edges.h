// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/discontinuity_sources.h"
#include "mesh/rays.h"
#include "mesh/silhouettes.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Which edges of the occluders matter to a source.
struct SeenEdges {
  std::vector<std::uint8_t> lit;       ///< [edges] the source shines past the edge
  std::vector<std::uint8_t> around;    ///< [edges] seen from either side of an opening's pane; zero for other sources
  std::vector<std::uint8_t> outdoors;  ///< [edges] seen from the opening, the edge ends the sky; zero for other sources
};

/// Looks past each edge, on its free side, from points of the source: corners, middles of edges and the middle of a polygon, to three
/// points of the edge. What none of these rays passes is left out: an edge that is seen through a slit alone may be missed.
SeenEdges seen_edges(const Occluders& occluders, const ShadowSource& source, const Rays& rays);

}  // namespace clerestory::mesh
