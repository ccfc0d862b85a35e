// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lighting/discontinuities.h"
#include "lighting/local_pass.h"
#include "lighting/solution.h"
#include "lighting/solution_errors.h"
#include "mesh/faces.h"

namespace clerestory::lighting {

/// The mesh of the surfaces that are shown finer than they were solved: lines of discontinuity are edges of it, and elsewhere its
/// elements are as large as those of the solution, or smaller where the light of lamps is curved.
struct ShownMesh {
  SceneLines found;
  mesh::Triangulation mesh;         ///< faces that are shown by the elements of the solution have no triangles
  mesh::MeshReport report;          ///< of it
  std::vector<std::uint8_t> shown;  ///< [sides] non-zero where it is shown by this mesh
  std::vector<std::uint8_t> jump;   ///< [faces] non-zero where light itself jumps at lines, not only its slope
};

struct ShownOptions {
  double accuracy = 0.02;  ///< share of the illuminance that may be missed
  double dark_lux = 0.0;   ///< darker places count as if they had so much
  std::size_t most_elements =
      1'000'000;  ///< triangles; small elements give way first, then surfaces without lines, then the lightest lines
  std::span<const std::uint8_t> matters{};  ///< [sides] non-zero for those that come first; empty: all do
};

/// Finds the lines across which the elements of a solution miss more than they may, and meshes their faces, and those that the solution is
/// less sure of than it was asked to be. The number of lines, and what it costs to find and to light them, is bounded by the number of
/// elements of the solution on surfaces that matter.
ShownMesh shown_mesh(const Solution& solution, const SolutionErrors& errors, const LocalPass& local,
                     const ShownOptions& options, Progress& progress);

}  // namespace clerestory::lighting
