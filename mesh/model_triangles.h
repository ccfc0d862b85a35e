// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/model.h"

namespace clerestory::mesh {

/// The model with polygons of more than three corners cut into triangles: same surface, same winding, parts, materials and lines.
/// Corners are those of the polygon; one more where its edges cross. A polygon without area has no triangles, and vanishes.
Model cut_into_triangles(const Model& model);

/// The model with polygons that have holes cut into polygons without, the rest as in cut_into_triangles(). What lies next to narrow
/// triangles is kept together with them, so that no needles come about where that can be helped.
Model cut_at_holes(const Model& model);

}  // namespace clerestory::mesh
