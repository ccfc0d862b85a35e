// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "io/map_layout.h"
#include "io/map_mesh.h"
#include "io/map_scale.h"
#include "io/raster.h"

namespace clerestory::io {

/// Draws the scale's isolines, as far as they lie within the mask, with their values where there is room; what they take is
/// marked.
void draw_isolines(Raster& raster, Occupied& occupied, const MapMesh& mesh, const MapLayout& layout,
                   const MapScale& scale, const Mask& within);

/// Prints the values of sensors where there is room, at their places or beside their dots; a regular choice of them where
/// they are dense; at their places only where the mask covers the whole number.
void draw_values(Raster& raster, Occupied& occupied, const MapPlan& plan, const MapLayout& layout,
                 std::span<const float> values, const Mask& painted);

/// Draws sensors without cells as dots in the colours of their values; what they take is marked.
void draw_dots(Raster& raster, Occupied& occupied, const MapPlan& plan, const MapLayout& layout,
               std::span<const float> values, const MapScale& scale);

}  // namespace clerestory::io
