// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/study.h"
#include "mesh/geometry.h"

namespace clerestory::lighting {

/// Illuminance by a point source at an unobstructed point [lux]: inverse square and cosine laws.
double point_illuminance(const PointSource& source, const mesh::Point& at, const mesh::Vector& normal);

}  // namespace clerestory::lighting
