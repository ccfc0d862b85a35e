// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "mesh/face_drafts.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Takes out the vertices in which every face that has them goes straight on, all along the same line: what is left of triangles that were
/// merged, as the ends of slivers along a wall. Lines are displaced by no more than rounding (1e-6 m), alike in all faces that share them.
/// Where nothing is taken out, nothing is different; else the vertices are numbered anew, in order. Before contacts are looked for.
/// Costs O(n log n) where what is not straight turns by little at a time.
/// @param stays  [faces] non-zero: all vertices of the face stay
void drop_straight_vertices(FaceDrafts& drafts, std::span<const std::uint8_t> stays);

}  // namespace clerestory::mesh
