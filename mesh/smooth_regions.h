// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/faces.h"

namespace clerestory::mesh {

/// Which regions of curved faces are one surface: those of one part and material that meet at an edge of the shape where no third region
/// ends, so that no other face stands on it.
/// @return  [faces][regions of the face] a number, the same for the regions of one surface; empty for flat faces
std::vector<std::vector<std::uint32_t>> smooth_regions(const Faces& faces);

}  // namespace clerestory::mesh
