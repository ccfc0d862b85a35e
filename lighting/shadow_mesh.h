// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lighting/discontinuities.h"
#include "lighting/solution.h"
#include "mesh/faces.h"

namespace clerestory::lighting {

/// The mesh of the surfaces on which shadows fall, for what is shown of a solution: lines of discontinuity are edges of it, and elsewhere its
/// elements are as large as those of the solution.
struct ShadowMesh {
  SceneLines found;
  mesh::Triangulation mesh;        ///< faces without lines have no triangles
  mesh::MeshReport report;         ///< of it
  std::vector<std::uint8_t> lit;   ///< [sides] non-zero where lines of the side are in the mesh
  std::vector<std::uint8_t> jump;  ///< [faces] non-zero where light itself jumps at lines, not only its slope
};

/// Finds the lines across which the elements of a solution miss more than they may, and meshes their faces.
/// Their number, and what it costs to find and to light them, is bounded by the number of elements of the solution.
/// @param scale_lux      illuminance of which a twentieth is the darkest that is told apart: the sensors' mean
/// @param most_elements  triangles of the mesh
ShadowMesh shadow_mesh(const Solution& solution, double accuracy, double scale_lux, std::size_t most_elements);

}  // namespace clerestory::lighting
