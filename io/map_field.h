// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/map_layout.h"
#include "io/map_mesh.h"
#include "io/map_scale.h"
#include "io/raster.h"

namespace clerestory::io {

/// What of the picture may be coloured: the rooms, without the holes that furniture makes in their outlines, and the cells
/// that lie outside of every outline.
Mask field_mask(const MapPlan& plan, const MapLayout& layout);

/// Paints the values of a mesh in the colours of a scale, bilinear in each quadrilateral, within the mask.
/// Gives what was painted.
Mask paint_field(Raster& raster, const MapMesh& mesh, const MapLayout& layout, const MapScale& scale,
                 const Mask& within);

}  // namespace clerestory::io
