// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/face_drafts.h"

// Private to mesh/.
namespace clerestory::mesh {

struct NearContactOptions {
  double gap_m = 0.0;  ///< up to which a contact is meant
  std::vector<bool>
      passable_materials{};  ///< by material, glazing and air: nothing stands on them, nor do they; empty: none
};

/// Closes contacts that were meant: where a face stands on another one but for a gap (a cabinet 0.2 mm above its floor, a cupboard before its
/// wall), a strip along its lowest edge goes straight down to the other face, of the material and part of the first. The strip's foot is a
/// contact like any other, and what it encloses is dark. Nothing moves, so that solids keep their shape however many faces they stand on.
/// A face stands on another one along an edge that lies before it within the gap, at least twice as long as it is wide, where no other corner
/// of the face is nearer, and the two make an angle of at least 45 degrees. What runs along the other face's boundary gets no strip.
/// @return the number of strips, which are appended to the faces
std::size_t close_near_contacts(FaceDrafts& drafts, const NearContactOptions& options);

}  // namespace clerestory::mesh
