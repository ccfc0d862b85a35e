// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "lighting/clusters.h"
#include "lighting/direct_light.h"
#include "lighting/links.h"
#include "lighting/solution.h"
#include "mesh/progress.h"

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
  std::vector<GroupDirect> groups;  ///< the same by group, where groups are told apart
  /// Standard error of a receiver's illuminance by one of the links, as the radiosities stand.
  struct Noise {
    mesh::ElementId receiver;
    double lux = 0.0;
  };
  std::vector<Noise> noise;
};

/// Follows links whose source is a pane, or a cluster of panes, on to what the pane mirrors: form factors that pass by an ideal specular
/// reflection, by recursive ray tracing [Sillion, Puech 1989]. The links themselves only tell how finely the panes must be seen, and how
/// much light to expect: that decides the number of rays, so that what they find cannot.
/// Where the progress says that it should finish, few rays must do; the noise tells.
/// @param tolerance_lux  of a receiver: the noise that one link may have
MirroredLight follow_mirrors(const Solution& solution, const Clusters& clusters, std::span<const Link> to_panes,
                             const std::function<double(mesh::ElementId)>& tolerance_lux, std::uint64_t seed,
                             const Progress& progress);

}  // namespace clerestory::lighting
