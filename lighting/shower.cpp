// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/shower.h"

#include <array>
#include <cmath>
#include <set>

#include "lighting/dark_share.h"
#include "lighting/element_mesh.h"
#include "lighting/limited_progress.h"
#include "lighting/lit_mesh.h"
#include "lighting/local_pass.h"
#include "lighting/surface_values.h"
#include "mesh/phase_part.h"

namespace clerestory::lighting {

namespace {

/// Of the time for lighting the mesh, measured on the validation scenes.
constexpr double kShareOfLitMesh = 0.9;

/// Where the sky goes out of sight in the planes of a grid's sensors.
void find_no_sky(const SceneLines& found, const mesh::Vector& origin, GridResult& grid) {
  std::set<std::array<long, 4>> planes;  // normal and offset, in thousandths
  const auto thousandths = [](double x) { return std::lround(1000.0 * x); };
  for (std::size_t i = 0; i < grid.sensors.cells.size(); ++i) {
    const mesh::Point at = grid.sensors.positions[i] - origin;
    const auto& cell = grid.sensors.cells[i];
    const mesh::Vector n = normalized(cross(cell[1] - cell[0], cell[3] - cell[0]));
    const double offset = dot(at - mesh::Point{}, n);
    if (!planes.insert({thousandths(n.x), thousandths(n.y), thousandths(n.z), thousandths(offset)}).second) continue;
    for (const mesh::NoSkySurface& surface : found.no_sky) {
      const auto cut = mesh::cut_by_plane(surface, at, n);
      if (cut) grid.no_sky.push_back({(*cut)[0] + origin, (*cut)[1] + origin});
    }
  }
}

}  // namespace

Shower::Shower(const Study& study, const Solution& solution, const Arrivals& arrivals, const SolutionErrors& errors,
               std::span<const NodeDirect> nodes, const Importance& importance, Progress& progress)
    : nodes_(nodes), accuracy_(study.accuracy.target), dark_lux_(kDarkShare * importance.mean_lux()) {
  if (!study.mesh.discontinuities) return;
  try {
    const LocalPass local(solution, arrivals, errors, nodes_, accuracy_, dark_lux_);
    progress.advance(0.0);
    shown_ = shown_mesh(solution, errors, local,
                        {accuracy_, dark_lux_, study.mesh.max_elements, importance.reached_sides()}, progress);
    progress.advance(1.0);
  } catch (const LimitedProgress::ShowingIsOver&) {
    is_over_ = true;
  }
}

void Shower::give_up() {
  is_over_ = true;
  shown_.reset();
}

SurfaceResult Shower::light(const Solution& solution, const Arrivals& arrivals, const SolutionErrors& errors,
                            Progress& progress) const {
  if (!shown_) return surface_values(solution, errors);
  const LocalPass local(solution, arrivals, errors, nodes_, accuracy_, dark_lux_);
  PhasePart lighting(progress, 0.0, kShareOfLitMesh);
  const LitMesh lit = light_mesh(solution, *shown_, local, lighting);
  PhasePart curved(progress, kShareOfLitMesh, 1.0);
  return surface_values(solution, errors, *shown_, lit, local, curved);
}

void tell_of_lines(const Shower& shower, const Scene& scene, Results& results) {
  if (shower.is_over())
    results.notices.emplace_back("the run was stopped before the shadow lines of the surfaces were found");
  if (!shower.mesh()) return;
  const ShownMesh& shown = *shower.mesh();
  results.shadow_lines = {element_lines(scene, shown.found), shown.found.selection, shown.report};
  for (GridResult& grid : results.grids) find_no_sky(shown.found, scene.faces.origin, grid);
}

}  // namespace clerestory::lighting
