// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "mesh/geometry.h"

namespace clerestory::mesh {

/// The corners of a closed loop without those where it goes straight on, to 1e-6 rad; where it turns back, it keeps its corner.
std::vector<Point> without_straight_corners(std::span<const Point> loop);

}  // namespace clerestory::mesh
