// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/defects.h"
#include "mesh/soup.h"

// Private to mesh/.
namespace clerestory::mesh {

/// The width of gaps that come from how a file writes its coordinates [m]: 0.9 of the step of their last decimal, since what was rounded
/// lies within √3/2 of it from where it was meant to be, while what differs on purpose differs by a whole step; for coordinates in single
/// precision two steps of that. 1 mm at most; the tolerance at least.
double gap_of_precision(const Soup& soup, double tolerance);

/// Up to which width gaps are closed [m].
struct GapWidth {
  double any_m = 0.0;   ///< at every corner
  double wide_m = 0.0;  ///< at corners whose sides are 500 times as long as what they move by; at least any_m
};

/// What is closed unasked: any gap that the coordinates' precision explains, and 1 mm beside long sides: a wall that stops so short of its
/// floor was meant to stand on it, whichever way the model is turned.
GapWidth gap_unasked(const Soup& soup, double tolerance);

/// Draws corners at open edges to the nearest vertex, edge or polygon within the gap, as far as they do not share a polygon with it: so sheets
/// that should meet do. A corner is left where its polygon would be drawn flat onto one that it lies before (a picture on a wall), where it
/// would turn a polygon over or make two of them one. Counts "gaps", a corner each. Vertices must be welded and split into edges.
/// @return whether anything changed; then vertices have to be welded and edges split again
bool close_gaps(Soup& soup, const GapWidth& gap, double tolerance, DefectList& defects);

}  // namespace clerestory::mesh
