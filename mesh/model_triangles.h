// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/model.h"

namespace clerestory::mesh {

/// Which polygons a file format cannot hold.
enum class CutPolygons { kWithHoles, kWithMoreThanThreeCorners };

/// The model with such polygons cut into triangles: same surface, same winding, parts, materials and lines. Corners are those of the
/// polygon; one more where its edges cross. A polygon without area has no triangles, and vanishes.
Model cut_into_triangles(const Model& model, CutPolygons which);

}  // namespace clerestory::mesh
