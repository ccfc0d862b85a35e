// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/grid_surface.h"
#include "lighting/results.h"
#include "lighting/study.h"

namespace clerestory::lighting {

/// Largest distance of the sensors of a grid over a field whose longer side (shorter, where the ratio is two or more) is d:
/// p = 0.2 · 5^log10(d), at most 10 m. Source: EN 12464-1:2021, 4.4.
double en12464_spacing_m(double side_a_m, double side_b_m);

/// The margin of a request on a surface of this smaller width: what is asked, else the smaller of 0.5 m and 15 %.
double margin_m(const GridRequest& request, double smaller_width_m);

/// Adds the sensors of one surface: cells tile the rectangle about its outline, less the margin; their number along each side is
/// rounded and their size follows, so that they fill it; those stay whose centre lies in the outline and the margin away from it.
/// Along the surface's main direction first, then across. Local coordinates [m].
/// Throws InputError when the spacing would give millions of cells.
void lay_out(const GridRequest& request, const GridSurface& surface, Sensors& sensors);

/// Adds one sensor where a surface is widest, with a cell of its own there: for surfaces so narrow that lay_out() finds no place.
/// Local coordinates [m].
void lay_out_middle(const GridRequest& request, const GridSurface& surface, Sensors& sensors);

/// The cells of given points that form a rectangular lattice, gaps allowed; nothing when they do not.
std::vector<std::array<mesh::Point, 4>> lattice_cells(const std::vector<mesh::Point>& points,
                                                      const std::vector<mesh::Vector>& normals);

}  // namespace clerestory::lighting
