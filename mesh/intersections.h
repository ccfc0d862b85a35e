// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "mesh/defects.h"
#include "mesh/progress.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Where closed solids meet, pair by pair of their polygons. These are no defects: what lies between solids is never lit, and faces are
/// imprinted with the lines where they meet.
struct SolidMeetings {
  std::size_t contacts = 0;   ///< polygons of two solids, or of one, that lie face to face
  std::size_t crossings = 0;  ///< that poke through each other, and could not be cut
};

/// Cuts polygons that poke through each other along the line where they do, those that lie on each other in one plane along each other's
/// sides, and those whose sides cross at the crossings. The pieces share vertices. Of what lies on each other one piece is left: that
/// of the smaller surface (coplanar, connected polygons of one part and material), which was laid on the larger one; of equal ones that of
/// the earlier in the file. A crossing that ends inside both polygons is cut by triangles.
/// Pieces that go are still there, marked as covered, until drop_covered(): so what opens can be told from what they left.
/// A polygon whose pieces would not have its area stays as it is and is told as left. Vertices must be welded, and polygons planar
/// within a few tolerances. Counts "overlapping polygons", a pair each, "intersecting polygons", a pair each, and
/// "self-crossing polygons". Contacts of solids (mark_solids()) stay as they are.
/// @param left_alone  sources of polygons whose pairs are told as left
/// @param meetings    receives the number of contacts, and of crossings of solids that were left alone
/// @param progress    hears which share of the work is done
/// @return whether anything changed; then vertices near new ones have to be welded, and edges split at new vertices
bool resolve_intersections(Soup& soup, double tolerance, const std::vector<std::string>& material_names,
                           const std::unordered_set<std::uint32_t>& left_alone, DefectList& defects,
                           SolidMeetings& meetings, Progress& progress);

/// Tells what is there and is not checked yet as left, but for meetings of solids.
void leave_intersections(const Soup& soup, double tolerance, std::string_view reason, DefectList& defects,
                         SolidMeetings& meetings);

/// Sources of polygons that have more open edges than before, or will have once the covered pieces are dropped: edges that a covered
/// piece shares with one polygon alone that is no covering one.
std::unordered_set<std::uint32_t> opened_sources(const Soup& before, const Soup& after);

/// Sources of the polygons that have an edge in common with those of some sources, and these.
std::unordered_set<std::uint32_t> sources_beside(const Soup& soup, const std::unordered_set<std::uint32_t>& sources);

/// Drops the pieces that lie on others.
void drop_covered(Soup& soup);

}  // namespace clerestory::mesh
