// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/defects.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Finds stray specks: polygons that hang together by vertices, are smaller than 5 mm and have nothing as near to them as they are long. Removes
/// those smaller than 1 mm whose material is found on larger things too; the others are told and left, since they may be meant: an
/// indicator lamp, say. Counts "stray specks", one each.
void remove_specks(Soup& soup, DefectList& defects);

}  // namespace clerestory::mesh
