// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <unordered_map>
#include <vector>

#include "mesh/face_drafts.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Vertices by the edge that they are to split, in any order.
using PendingSplits = std::unordered_map<Edge, std::vector<std::uint32_t>, EdgeHash>;

/// Calls visit(edge) for every segment of the face, boundary and lines.
template <class Visit>
void for_each_segment(const FaceDraft& face, const Visit& visit) {
  for (const auto& [a, b] : face.boundary) visit(edge_between(a, b));
  for (const Edge& e : face.lines) visit(e);
}

/// Finds what meets in the plane of one face though its vertices lie off the plane, on either side: makes vertices at the same
/// place of the plane one in this face, and asks for splits of segments at vertices on them, or, where there are none,
/// where segments cross. New vertices for crossings are added to the drafts.
void find_meetings_in_plane(FaceDrafts& drafts, FaceDraft& face, PendingSplits& pending);

}  // namespace clerestory::mesh
