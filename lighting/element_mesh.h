// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lighting/results.h"
#include "lighting/study.h"
#include "mesh/discontinuity_selection.h"
#include "mesh/faces.h"
#include "mesh/geometry.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// The start elements of a study, one cell a side that takes part in the solution; model coordinates [m]. Arrays by cell.
struct ElementMesh {
  std::vector<mesh::Point> points;
  std::vector<std::array<std::uint32_t, 3>> cells;
  std::vector<std::uint8_t> side;
  std::vector<std::int32_t> level;   ///< below the region, in the element tree
  std::vector<float> size_m;         ///< longest edge
  std::vector<float> min_angle_deg;  ///< of the triangle
  std::vector<std::int32_t> part;
  std::vector<std::int32_t> material;
  std::vector<std::int32_t> face;
  std::vector<std::int32_t> region;  ///< of the face: what boundary and contacts leave connected
  std::vector<std::int32_t> patch;   ///< of the face: what lines of discontinuity leave connected, too
  std::vector<std::uint8_t> shade;   ///< mesh::Shade: 0 faces no source, 1 lit, 2 penumbra, 3 umbra
  std::vector<std::string> part_names;
  std::vector<std::string> material_names;
};

struct MeshedStudy {
  ElementMesh elements;
  ElementLines lines;
  mesh::LineSelection selection;
  mesh::MeshReport report;
  std::vector<std::string> notices;
};

/// Meshes the surfaces of a study with the lines of discontinuity of its sources, to the study's accuracy.
/// @param lines_only  leaves the elements out
/// Throws InputError as build_scene() does.
MeshedStudy mesh_study(const Study& study, bool lines_only, Progress& progress);

}  // namespace clerestory::lighting
