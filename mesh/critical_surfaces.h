// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

#include "mesh/discontinuity_sources.h"
#include "mesh/geometry.h"
#include "mesh/ids.h"
#include "mesh/seen_edges.h"
#include "mesh/silhouettes.h"

// Private to mesh/.
namespace clerestory::mesh {

/// A planar critical surface: the lines through a vertex (the pivot) and the points of an edge. Where such a line touches the source and
/// an occluder, light is discontinuous on what it meets behind the occluder.
/// Sources: Heckbert1992; LischinskiTampieriGreenberg1992; DrettakisFiume1994.
struct Wedge {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  enum class Kind : std::uint8_t {
    kVertexEdge,  ///< VE: the pivot belongs to the source, the edge to the occluder; light goes on beyond the edge
    kEdgeVertex,  ///< EV: the edge belongs to the source, the pivot to the occluder; light goes on beyond the pivot
  };

  Kind kind = Kind::kVertexEdge;
  bool parallel = false;  ///< the pivot lies at infinity, in the direction `towards`
  Point pivot;
  Vector towards;             ///< unit; where parallel
  std::array<Point, 2> edge;  ///< [m]
  /// Unit normal of the plane. On its side lines pass the occluder: surfaces that touch the plane from the other side do not shut it.
  Vector free_side;
  std::uint32_t pivot_vertex = kNone;  ///< of Occluders, where the pivot is one of them
  bool sky_behind = false;             ///< the source is the sky beyond what the lines touch first: they must reach it
  std::uint8_t order = 2;              ///< of the derivative of the illuminance that jumps
  /// What comes out from behind the edge, or ends behind it, at the pivot: for order 1 the edge that lies in the plane with it, for order 2 the
  /// directions of the two edges that meet there.
  std::array<Point, 2> along{};
  std::array<Vector, 2> corner{};
  bool no_sky = false;  ///< of the pair of a window's head and a roof line outdoors
  FaceId occluder;      ///< a face at the edge or vertex that casts the shadow
};

/// Which critical surfaces are wanted.
struct WedgeLimit {
  std::size_t most = 200000;        ///< of a source
  const SeenEdges* seen = nullptr;  ///< edges that matter; null: all may
};

/// Calls visit for the critical surfaces of a source with all occluders: VE and EV for a polygon, shadow edges (order 0) for points
/// and directions, and for an opening before the sky also those of the surfaces round the opening with what stands outdoors.
/// Surfaces of three edges (EEE, quadrics) are left out.
/// @return false where the limit was reached
bool for_each_wedge(const Occluders& occluders, const ShadowSource& source, const WedgeLimit& limit,
                    const std::function<void(const Wedge&)>& visit);

}  // namespace clerestory::mesh
