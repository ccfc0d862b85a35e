// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/scene.h"
#include "lighting/study.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// Illuminance by a point source at an unobstructed point [lux]: inverse square and cosine laws.
double point_illuminance(const PointSource& source, const mesh::Point& at, const mesh::Vector& normal);

/// Illuminance by all point sources of a scene at a point off its surfaces [lux]: straight, through panes and openings, and by one
/// reflection in each pane, as of the source's image behind it.
double point_source_illuminance(const Scene& scene, const mesh::Point& at, const mesh::Vector& normal);

}  // namespace clerestory::lighting
