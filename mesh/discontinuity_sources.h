// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/geometry.h"

namespace clerestory::mesh {

/// What casts the shadows that discontinuity_lines.h looks for: plain geometry with a weight. Local coordinates [m].
struct ShadowSource {
  enum class Kind : std::uint8_t {
    kPolygon,    ///< a planar polygon: an area luminaire, or the pane of an opening
    kPoint,      ///< a point luminaire
    kDirection,  ///< the sun, taken as a point at infinity
  };

  Kind kind = Kind::kPolygon;
  /// kPolygon: closed loops of corners, the outer one and holes, wound any way.
  std::vector<std::vector<Point>> outline;
  /// kPolygon: unit normal of the side that shines; of an opening it points into the darker space.
  Vector normal;
  bool two_sided = false;
  /// kPolygon: the sky shines through it, so that what stands outdoors before the sky makes lines indoors as well.
  bool sky = false;
  Point at;        ///< kPoint
  Vector towards;  ///< kDirection: unit vector from the scene to the source
  /// What it brings to the scene, in any unit that is one for all sources: the stronger goes first.
  double power = 0.0;
};

}  // namespace clerestory::mesh
