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

}  // namespace clerestory::mesh
