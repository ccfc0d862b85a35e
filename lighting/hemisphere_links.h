// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lighting/seen_surfaces.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// What a node sees by rays from all over it into its whole hemisphere: the rows of the form-factor matrix by ray casting [Malley's
/// method: Maxwell, Bailey, Goldschmidt 1986; Wallace, Elmquist, Haines 1989]. For nodes that hardly matter this costs what their light
/// distribution needs, whatever the number of surfaces around.
struct HemisphereView {
  /// Surfaces that shine by themselves are left out, but in panes: they have links of their own.
  std::vector<SeenSurface> seen;
  /// Where on the node the rays begin, from its centroid along its axes [m]; one for each of `seen`.
  std::vector<std::array<float, 2>> from;
  double mirrored_sky_lux = 0.0;            ///< sky seen in panes
  std::vector<GroupLight> mirrored_groups;  ///< the same by group, where groups are told apart
  std::uint32_t rays = 0;

  /// Illuminance by the radiosities of a solution as they stand.
  struct Estimate {
    double mean_lux = 0.0;
    LinearValue slope;            ///< of the line that fits best over the node, per unit of the mean [1/m]
    double error_lux = 0.0;       ///< standard error of the mean
    double line_error_lux = 0.0;  ///< standard error of the line's rise and fall about that mean, RMS over the node
  };
  [[nodiscard]] Estimate estimate(const Solution& solution, mesh::ElementId node) const;

  /// Where the rays of each of the independent sets begin in `seen` [kSets + 1].
  static constexpr std::size_t kSets = 4;
  std::array<std::size_t, kSets + 1> starts{};
};

/// Looks around from a node with so many rays, in sets of equal size with a scrambling each.
HemisphereView look_around(const Solution& solution, mesh::ElementId node, std::uint32_t rays, std::uint64_t seed);

}  // namespace clerestory::lighting
