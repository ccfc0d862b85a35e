// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/faces.h"
#include "mesh/regions.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Which sides of regions bound the same space as neighbours round an edge tell: about each edge, sides that face each other across the
/// angle between two triangles do, and so do both sides of a sheet at its free edge [the radial-edge structure: Weiler 1986]. A space may have more
/// than one shell, such as a room and what stands free in it; sides of one shell bound one space, where every contact is imprinted.
/// @return [2 a region, front first] the smallest member of each side's shell
std::vector<std::uint32_t> side_shells(const Faces& faces, const Regions& regions);

}  // namespace clerestory::mesh
