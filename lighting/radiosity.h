// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/clusters.h"
#include "lighting/direct_light.h"
#include "lighting/importance.h"
#include "lighting/links.h"
#include "lighting/solution.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// What solve() leaves beside the solution.
struct Transport {
  std::vector<Link> links;  ///< sorted by receiver; openings' links among them
  Clusters clusters;
  std::size_t iterations = 0;
  double convergence = 0.0;  ///< share of the reflected flux that iterations not made would still change
};

struct SolveOptions {
  double link_tolerance = 1e-5;  ///< error at the sensors that one link may cause, as a share of their mean illuminance
  double node_tolerance = 4e-5;  ///< the same for all that one node sees by rays
  double accuracy = 0.02;        ///< iterations go on until what is missing is far below
  std::uint64_t seed = 0;
};

/// Hierarchical radiosity: links refined from coarse to fine [multigridding: Hanrahan, Salzman, Aupperle 1991], solved by
/// gathering with push and pull until what is missing is far below the accuracy.
/// Roots that hardly matter to the sensors look around by rays instead of linking to all that surrounds them.
Transport solve(Solution& solution, const Importance& importance, DirectLight direct, const SolveOptions& options,
                Progress& progress);

}  // namespace clerestory::lighting
