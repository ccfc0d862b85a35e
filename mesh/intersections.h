// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <unordered_set>
#include <vector>

#include "mesh/defects.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Cuts polygons that poke through each other along the line where they do, those that lie on each other in one plane along each other's
/// sides, and those whose sides cross at the crossings. The pieces share vertices. Of what lies on each other one piece is left: that
/// of the smaller surface (coplanar, connected polygons of one part and material), which was laid on the larger one; of equal ones that of
/// the earlier in the file. A crossing that ends inside both polygons is cut by triangles.
/// Pieces that go are still there, marked as covered, until drop_covered(): so what opens can be told from what they left.
/// A polygon whose pieces would not have its area stays as it is and is told as left. Vertices must be welded, and polygons planar
/// within a few tolerances. Counts "overlapping polygons", a pair each, "intersecting polygons", a pair each, and
/// "self-crossing polygons".
/// @param left_alone  sources of polygons whose pairs are told as left
/// @return whether anything changed; then vertices near new ones have to be welded, and edges split at new vertices
bool resolve_intersections(Soup& soup, double tolerance, const std::vector<std::string>& material_names,
                           const std::unordered_set<std::uint32_t>& left_alone, DefectList& defects);

/// Tells what is there after all cutting, as left.
void leave_intersections(const Soup& soup, double tolerance, DefectList& defects);

/// Sources of polygons that have more open edges than before, or will have once the covered pieces are dropped: edges that a covered
/// piece shares with one polygon alone that is no covering one.
std::unordered_set<std::uint32_t> opened_sources(const Soup& before, const Soup& after);

/// Drops the pieces that lie on others.
void drop_covered(Soup& soup);

}  // namespace clerestory::mesh
