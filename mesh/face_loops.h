// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/faces.h"

// Private to mesh/.
namespace clerestory::mesh {

/// The loops around a face's triangles: outer boundaries counter-clockwise seen from the front, holes clockwise. Loops that touch in a
/// vertex stay apart.
std::vector<std::vector<std::uint32_t>> boundary_loops(std::span<const Triangle> triangles);

}  // namespace clerestory::mesh
