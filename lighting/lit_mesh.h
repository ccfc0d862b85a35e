// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lighting/local_pass.h"
#include "lighting/shown_mesh.h"
#include "lighting/solution.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// The light on a mesh that is shown, computed at its points; linear over its cells.
struct LitMesh {
  struct Cell {
    std::array<std::uint32_t, 3> points;
    mesh::ElementId element;  ///< of the solution, that holds its middle
    mesh::Point middle;
    double area = 0.0;
  };

  std::vector<mesh::Point>
      points;  ///< of one region of one face side each, and where light jumps at lines of one patch
  std::vector<Cell> cells;
  std::vector<double> lux;        ///< [points × channels]
  std::vector<double> error_lux;  ///< [points] standard error
};

/// Lights all sides of a mesh that are to be shown by it, by the local pass.
LitMesh light_mesh(const Solution& solution, const ShownMesh& shown, const LocalPass& local, Progress& progress);

}  // namespace clerestory::lighting
