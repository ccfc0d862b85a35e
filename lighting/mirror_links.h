// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lighting/clusters.h"
#include "lighting/links.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// What receivers see in panes as in mirrors.
struct MirroredLight {
  std::vector<Link> links;  ///< from the surfaces that are seen
  /// Sky that is seen, one entry a receiver.
  struct FromSky {
    mesh::ElementId receiver;
    LinearValue lux;
  };
  std::vector<FromSky> sky;
};

/// Follows links whose source is a pane, or a cluster of panes, on to what the pane mirrors: form factors that pass by an ideal specular
/// reflection, by recursive ray tracing [Sillion, Puech 1989]. The links themselves only tell how finely the panes must be seen.
MirroredLight follow_mirrors(const Solution& solution, const Clusters& clusters, std::span<const Link> to_panes,
                             std::uint64_t seed);

}  // namespace clerestory::lighting
