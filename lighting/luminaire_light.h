// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lighting/luminous_area.h"
#include "lighting/scene.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// Illuminance by a luminaire at an unobstructed point [lux]: inverse square and cosine laws, over its luminous opening where the point is near.
AreaMean illuminance_by(const Luminaire& luminaire, const mesh::Point& at, const mesh::Vector& normal);

/// Illuminance by all luminaires of a scene at a point off its surfaces [lux]: straight, through panes and openings, and by one
/// reflection in each pane, as of the luminaire's image behind it.
AreaMean luminaire_illuminance(const Scene& scene, const mesh::Point& at, const mesh::Vector& normal);

/// The same; the groups of the luminaires are given a share of it.
AreaMean luminaire_illuminance(const Scene& scene, const mesh::Point& at, const mesh::Vector& normal, double share,
                               GroupSums& groups);

/// The faces that a luminaire is flush with: those that cross its luminous opening's box, enlarged by 5 cm, and lie across its axis. They do not
/// stand in the way of its light on the side to which it aims, as nothing else does in that box.
std::vector<mesh::FaceId> flush_faces(const Scene& scene, const Luminaire& luminaire);

/// A point from which the light of a luminaire spreads: before its box and what it is flush with.
mesh::Point light_start(const Luminaire& luminaire, const std::vector<mesh::FaceId>& flush);

}  // namespace clerestory::lighting
