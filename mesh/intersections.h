// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "mesh/defects.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Cuts polygons that poke through each other along the line where they do, those that lie on each other in one plane along each other's
/// sides, and those whose sides cross at the crossings. The pieces share vertices. Of what lies on each other one piece is left: that
/// of the smaller surface (coplanar, connected polygons of one part and material), which was laid on the larger one; of equal ones that of
/// the earlier in the file. A crossing that ends inside both polygons is cut by triangles.
/// A polygon whose pieces would not have its area stays as it is and is told as left. Vertices must be welded, and polygons planar
/// within a few tolerances. Counts "overlapping polygons", a polygon each, "intersecting polygons", a pair each, and
/// "self-crossing polygons".
/// @return whether anything changed; then vertices near new ones have to be welded, and edges split at new vertices
bool resolve_intersections(Soup& soup, double tolerance, const std::vector<std::string>& material_names,
                           DefectList& defects);

}  // namespace clerestory::mesh
