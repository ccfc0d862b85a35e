// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "lighting/luminaire_view.h"
#include "lighting/luminous_area.h"
#include "lighting/receiver.h"
#include "lighting/scene.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// Illuminance by a luminaire at an unobstructed point [lux]: inverse square and cosine laws, over its luminous opening where the point is near.
AreaMean illuminance_by(const Luminaire& luminaire, const mesh::Point& at, const mesh::Vector& normal);

/// About that by all luminaires of a scene at a point off its surfaces [lux]: straight from their middles.
double luminaire_glance(const Scene& scene, const mesh::Point& at, const mesh::Vector& normal);
/// The same by a few of them, which are right on the average.
/// @param pick  evenly spread over [0, 1): decides which
double luminaire_guess(const Scene& scene, const mesh::Point& at, const mesh::Vector& normal, double pick);

/// Illuminance by luminaires of a scene at a point off its surfaces [lux]: straight, through panes and openings, and by one reflection of any of
/// them in each pane, as of its image behind it.
/// @param views      those that may be seen straight
/// @param tolerance  share of each luminaire's light that may be missed where its opening is near and flat (lighting/luminaire_view.h)
AreaMean luminaire_illuminance(const Scene& scene, std::span<const LuminaireView> views, const mesh::Point& at,
                               const Receiver& receiver, double tolerance);

/// The same; the groups of the luminaires are given a share of it.
AreaMean luminaire_illuminance(const Scene& scene, std::span<const LuminaireView> views, const mesh::Point& at,
                               const Receiver& receiver, double tolerance, double share, GroupSums& groups);

/// The share of what a luminaire sends to a point off the scene's surfaces that gets there straight [0 … 1].
/// @param luminaire  its number in the scene
double seen_share(const Scene& scene, std::size_t luminaire, const mesh::Point& at);

}  // namespace clerestory::lighting
