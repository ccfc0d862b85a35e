// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "mesh/defects.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Winds the polygons of each shell alike: polygons that meet at an edge where no third one is, or where they alone are of one
/// part. Closed shells get their fronts outward (positive volume); of open ones the way of the larger area stays. Every polygon that is
/// turned is marked (SoupPolygon::flipped). Counts "mixed orientation", a polygon each, "inside-out shells", a closed shell
/// each, and leaves "one-sided shells" (as a Möbius strip is) alone.
/// @return the number of closed shells
std::size_t orient_shells(Soup& soup, DefectList& defects);

/// Fills SoupPolygon::outward: of shells that hold a volume, whichever way round their polygons are wound. Edges of a solid that lost a
/// piece to another thing's have that one's polygon, so that it is a solid still. Polygons that were marked otherwise are to be checked anew.
/// @return whether there are such
bool mark_solids(Soup& soup);

}  // namespace clerestory::mesh
