// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "mesh/clean.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Replaces thin solids and parallel sheets of the sheet materials by one sheet at the middle of their thickness: of parallel sheets
/// within the pane thickness of each other that cover each other by half or more, the layer of the largest area stays, moved to the
/// middle; the others, and what closes the rim between them, go. Sheets narrower than twice their distance are no panes.
/// Vertices must be shared where polygons touch.
/// @param notices  receives one sentence for each material, kind and thickness
/// @return whether anything changed
bool reduce_panes(Soup& soup, const CleanOptions& options, const std::vector<std::string>& material_names,
                  std::vector<std::string>& notices);

}  // namespace clerestory::mesh
