// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "lighting/results.h"
#include "lighting/scene.h"
#include "mesh/discontinuity_lines.h"
#include "mesh/discontinuity_selection.h"
#include "mesh/discontinuity_sources.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// What casts the shadows of a scene, the most powerful first.
struct ShadowSources {
  std::vector<mesh::ShadowSource> sources;
  std::vector<std::string> names;  ///< part or material of each
  std::vector<double>
      exitance_lm_m2;  ///< of polygons: what shines, the sky through a pane included; of points their intensity [cd], of the sun its normal illuminance
  std::size_t left_out = 0;  ///< sources beyond the number that is taken
};

/// Openings, surfaces that shine, luminaires and the sun, by the power that they send into the scene.
/// @param without_extent  the sun and luminaires alone
ShadowSources shadow_sources(const Scene& scene, std::size_t most, bool without_extent = false);

/// The lines of discontinuity of a scene.
struct SceneLines {
  std::vector<mesh::DiscontinuityLine> lines;  ///< those kept, the weightiest first
  std::vector<mesh::NoSkySurface> no_sky;
  mesh::LineSelection selection;  ///< of all that were found; its indices mean nothing here
  ShadowSources sources;
  std::vector<std::string> notices;
};

/// How elements and light would be at a line if it were not in the mesh.
struct LineSurroundings {
  double element_size_m = 0.0;   ///< across the line
  double illuminance_lux = 0.0;  ///< by all light; what may be missed is a share of it
};

struct LineOptions {
  bool jumps_only =
      false;  ///< of the sun and of luminaires taken as points alone, across whose lines light itself jumps
  double tolerance = 0.02;  ///< share of the illuminance that may be missed
  /// Of a line; `across` is a unit vector in the plane of the face and at right angles to the line. Empty where there is no solution: then
  /// elements are as large as the face, half a metre at most, and the light is that of all sources, unoccluded.
  std::function<LineSurroundings(const mesh::DiscontinuityLine&, const mesh::Vector& across)> surroundings;
  std::size_t most_sources = 64;                                     ///< the strongest
  std::size_t most_lines = std::numeric_limits<std::size_t>::max();  ///< in all
  /// Traced in all; each source gets its share by power, so that the strongest are complete longest.
  std::size_t most_critical_surfaces = 200000;
  /// Hears of each step. Where it says that it should finish, sources are left out, and the step that follows is told.
  Progress* progress = nullptr;
};

/// Finds the lines of all sources and keeps those across which an interpolation would miss more than the tolerance: for a line of order k,
/// |jump of the k-th derivative| · h^k / k! against tolerance × local illuminance, h the size of the elements there without the line. The
/// jump is that in the middle of the line, and no more is missed than the occluder can cover of the source.
SceneLines find_discontinuities(const Scene& scene, const LineOptions& options);

/// The jump that a line's source makes across it, of the derivative of its order k, estimated at the middle of the line [lux/m^k].
double estimated_jump(const Scene& scene, const ShadowSources& sources, const mesh::DiscontinuityLine& line);

/// The lines kept, as they are written.
ElementLines element_lines(const Scene& scene, const SceneLines& found);

}  // namespace clerestory::lighting
