// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/defects.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// Drops corners that repeat the one before, and there-and-back spikes of no width (a, b, a becomes a); a loop may come out empty.
/// @return whether the loop changed
bool drop_repeated_corners(std::vector<std::uint32_t>& loop);

/// Drops repeated corners and spikes, holes of no area, and polygons of fewer than three distinct corners or no area (narrower than the
/// tolerance [m]). Counts "repeated corners", "degenerate holes" and "degenerate polygons".
/// @return whether anything changed
bool drop_degenerate(Soup& soup, double tolerance, DefectList& defects);

/// Drops polygons without three distinct corners or without a plane, which no later stage can take.
void drop_unusable(Soup& soup);

/// Of polygons with the same edges, either way round, keeps the first. Counts "duplicate polygons", and "duplicate polygons of
/// different material" where that decides which material is seen.
void drop_duplicates(Soup& soup, const std::vector<std::string>& material_names, DefectList& defects);

}  // namespace clerestory::mesh
