// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/defects.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Drops polygons and holes of fewer than three distinct corners, of no area, or so narrow that splitting edges at the vertices on them
/// closes what they leave (kOnEdgeShare of the tolerance [m]), after separate_loops(). Counts "degenerate polygons",
/// "needle polygons", "degenerate holes" and what separate_loops() counts.
/// @return whether anything changed
bool drop_degenerate(Soup& soup, double tolerance, DefectList& defects);

/// Drops polygons without three distinct corners or without a plane, which no later stage can take, after separate_loops().
void drop_unusable(Soup& soup);

/// What is known of a model's materials.
struct MaterialFacts {
  const std::vector<std::string>& names;
  const std::vector<bool>& passable;  ///< as CleanOptions::passable_materials
};

/// Of polygons with the same edges, either way round, keeps the first. Where one of another material lies the other way round, its
/// material becomes that of the back, and that is no defect. Counts "duplicate polygons", and "duplicate polygons of different material"
/// where which is kept decides what is seen.
void drop_duplicates(Soup& soup, const MaterialFacts& materials, DefectList& defects);

}  // namespace clerestory::mesh
