// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/defects.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Makes vertices closer than the tolerance one, at the place of the first of them.
/// Counts "duplicate vertices" (the same place) and "near-duplicate vertices".
void weld(Soup& soup, double tolerance, DefectList& defects);

/// Makes vertices at exactly the same place one.
void share_vertices(Soup& soup);

}  // namespace clerestory::mesh
