// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/defects.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Cuts polygons with a corner farther than the tolerance [m] from their mean plane into triangles between their own corners.
/// Counts
/// "non-planar polygons"; those whose sides cross in the plane are left.
/// @return whether anything changed
bool triangulate_nonplanar(Soup& soup, double tolerance, DefectList& defects);

}  // namespace clerestory::mesh
