// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lighting/arrivals.h"
#include "lighting/clusters.h"
#include "lighting/direct_light.h"
#include "lighting/importance.h"
#include "lighting/solution.h"
#include "lighting/solution_errors.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// What solve() leaves beside the solution.
struct Transport {
  Arrivals arrivals;                ///< openings' links among them; with their errors where these are to be kept
  std::vector<GroupDirect> groups;  ///< what the solution's direct light is made of, where groups are told apart
  double by_luminaires_lm = 0.0;    ///< flux that opaque nodes receive straight from luminaires
  std::vector<Solution::Errors>
      given_errors;  ///< [nodes] of what nodes receive by rays of their own but for suns, without the links' errors
  std::vector<double>
      given_lm;                 ///< [nodes] the light that these belong to: all but suns'; where links' errors are kept
  std::vector<SunDirect> suns;  ///< what is given by suns, and its errors
  Clusters clusters;
  SolutionErrors errors;
  std::size_t iterations = 0;
  double convergence = 0.0;      ///< share of the reflected flux that iterations not made would still change
  bool out_of_elements = false;  ///< whether links stay as they are because the solution may have no more elements
};

struct SolveOptions {
  double accuracy = 0.02;
  std::uint64_t seed = 0;
  /// Error at the sensors that one link may cause, as a share of the accuracy. Many such errors, of either sign, add up; measured on
  /// the validation scenes.
  double link_share = 0.0005;
  /// The same for all that one node sees by rays, which is right on the mean.
  double node_share = 0.02;
  /// The same for the rays of one link to a pane.
  double mirror_share = 0.1;
  /// What errors of a solution make at the sensors, as a share of their light; empty: links are refined as far as `link_share` says.
  std::function<double(const SolutionErrors&)> error_at_sensors = {};
  /// Refinement ends where that is no more than this share of the accuracy: the larger part is the sensors' own rays', which cost less to add.
  double discretisation_share = 0.55;
  bool clusters = true;           ///< as SolverParts has it
  bool keep_link_errors = false;  ///< for a solution that is stored
};

/// Hierarchical radiosity: links refined from coarse to fine [multigridding: Hanrahan, Salzman, Aupperle 1991], solved by
/// gathering with push and pull until what is missing is far below the accuracy. Refinement ends where the errors at the sensors are small
/// enough, where these are told, or at the tolerance of a link.
/// Roots that hardly matter to the sensors look around by rays instead of linking to all that surrounds them.
/// Where the progress says that it should finish, or the solution may have no more elements, pairs are linked as they are, and the errors
/// of the solution say so.
Transport solve(Solution& solution, const Importance& importance, DirectLight direct, const SolveOptions& options,
                Progress& progress);

}  // namespace clerestory::lighting
