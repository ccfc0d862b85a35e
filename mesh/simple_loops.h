// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/defects.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Takes loops apart where they come back to a vertex, and gives each polygon one outer loop and its holes: holes that files reach by a
/// bridge walked both ways, or that touch the outer loop in a corner, become loops of their own, whichever way round they go (even-odd
/// nesting); outer loops beside each other become polygons of their own. Repeated corners and there-and-back spikes vanish.
/// Counts "repeated corners" and "bridged loops". Polygons that are left without a loop are not counted.
/// @return whether anything changed
bool separate_loops(Soup& soup, DefectList& defects);

}  // namespace clerestory::mesh
