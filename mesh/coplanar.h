// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Polygons of one plane that hang together by edges.
struct CoplanarGroup {
  std::vector<std::uint32_t> polygons;  ///< ascending
  Plane plane;                          ///< of the largest polygon; its side is the front
};

struct CoplanarOptions {
  double plane_tolerance = 2e-5;  ///< distance of every vertex from the plane [m]
  double angle_tolerance =
      1e-4;  ///< between normals [rad]; more for polygons so narrow that the plane tolerance tilts them more
  bool same_part = true;  ///< groups end where another part begins
};

/// Groups the polygons of one material a side, plane and front that share edges and lie on different sides of them; a group never holds two
/// polygons that lie on each other at a shared edge. Every polygon that has a plane is in exactly one group.
/// Groups are in the order of their first polygon.
std::vector<CoplanarGroup> group_coplanar(const Soup& soup, const CoplanarOptions& options);

}  // namespace clerestory::mesh
