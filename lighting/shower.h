// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "lighting/direct_light.h"
#include "lighting/importance.h"
#include "lighting/results.h"
#include "lighting/shown_mesh.h"
#include "lighting/solution.h"
#include "lighting/solution_errors.h"
#include "lighting/study.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// Shows the light of a solution on the surfaces. Throws LimitedProgress::ShowingIsOver where the time for it is over.
class Shower {
 public:
  /// Finds the mesh with the lines of discontinuity where these are asked for and limits allow.
  /// @param solution  whose light the mesh follows
  /// @param arrivals  of its links
  /// @param nodes     of light_directly(); kept by reference
  /// @param importance  of the solution: surfaces that do not matter to the sensors are shown finely as long as they are few
  Shower(const Study& study, const Solution& solution, const Arrivals& arrivals, const SolutionErrors& errors,
         std::span<const NodeDirect> nodes, const Importance& importance, Progress& progress);

  [[nodiscard]] const std::optional<ShownMesh>& mesh() const { return shown_; }
  /// Whether the mesh, or light on it, could not be had in the time.
  [[nodiscard]] bool is_over() const { return is_over_; }
  /// From here on elements are shown.
  void give_up();

  [[nodiscard]] SurfaceResult light(const Solution& solution, const Arrivals& arrivals, const SolutionErrors& errors,
                                    Progress& progress) const;

 private:
  std::span<const NodeDirect> nodes_;
  double accuracy_;
  double dark_lux_;
  std::optional<ShownMesh> shown_;
  bool is_over_ = false;
};

/// Tells what is known of the lines, where they were found, and where the sky goes out of sight in the planes of grids.
void tell_of_lines(const Shower& shower, const Scene& scene, Results& results);

}  // namespace clerestory::lighting
