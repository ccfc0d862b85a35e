// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lighting/scene.h"
#include "mesh/discontinuity_lines.h"
#include "mesh/discontinuity_selection.h"
#include "mesh/discontinuity_sources.h"

namespace clerestory::lighting {

/// What casts the shadows of a scene, the most powerful first.
struct ShadowSources {
  std::vector<mesh::ShadowSource> sources;
  std::vector<std::string> names;  ///< part or material of each
  std::vector<double>
      exitance_lm_m2;  ///< of polygons: what shines, the sky through a pane included; of points their intensity [cd]
  std::size_t left_out = 0;  ///< sources beyond the number that is taken
};

/// Openings, surfaces that shine, and point sources, by the power that they send into the scene.
ShadowSources shadow_sources(const Scene& scene, std::size_t most = 64);

/// The lines of discontinuity of a scene.
struct SceneLines {
  std::vector<mesh::DiscontinuityLine> lines;  ///< those kept, the weightiest first
  std::vector<mesh::NoSkySurface> no_sky;
  mesh::LineSelection selection;  ///< of all that were found; its indices mean nothing here
  ShadowSources sources;
  std::vector<std::string> notices;
};

/// Finds the lines of all sources and keeps those across which an interpolation over elements of this size would miss more than
/// the tolerance: for a line of order k, |jump of the k-th derivative| · h^k / k! against tolerance × local illuminance. The jump is
/// estimated from the source's unoccluded illuminance at the middle of the line, and from how fast the occluder uncovers it. What
/// the sources give there together, unoccluded, stands for the local illuminance.
/// @param tolerance       as a share of the illuminance
/// @param element_size_m  h, of elements where no line is
SceneLines find_discontinuities(const Scene& scene, double tolerance, double element_size_m = 0.5);

}  // namespace clerestory::lighting
