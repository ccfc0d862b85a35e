// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lighting/scene.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// How far from a luminous opening nothing stands in its way [m]: the housing, and the edge of its cut-out.
inline constexpr double kHousingM = 0.05;

/// The faces that a luminaire is flush with: those that cross its luminous opening's box, enlarged by kHousingM, and lie across its axis. They do
/// not stand in the way of its light on the side to which it aims, as nothing else does in that box.
std::vector<mesh::FaceId> flush_faces(const Scene& scene, const Luminaire& luminaire);

/// A point from which the light of a luminaire spreads: before its box and what it is flush with.
mesh::Point light_start(const Luminaire& luminaire, const std::vector<mesh::FaceId>& flush);

/// Whether a luminaire stands inside a solid, as in a wall: all around it are the backs of faces, half of them within 0.4 m, and so they are where it
/// shines; some of the solid is farther than a metre away, or else it is a shade.
bool is_walled_in(const Scene& scene, const Luminaire& luminaire, const std::vector<mesh::FaceId>& flush);

}  // namespace clerestory::lighting
