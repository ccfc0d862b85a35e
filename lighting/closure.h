// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "lighting/arrivals.h"
#include "lighting/solution.h"

namespace clerestory::lighting {

/// Makes form factors add up to 1 where that is known: at elements whose whole hemisphere is filled by pieces that are proven visible.
/// Links are lines on both ends, so that sums of them miss 1 by what the lines do. What is exchanged is scaled by a factor of each end,
/// which keeps it symmetric (no flux is lost or won, what is dark stays dark), until all such sums are 1
/// [Sinkhorn, Knopp 1967; van Leersum 1989]. Sets Solution::closing of those elements.
void close_hemispheres(Solution& solution, const Arrivals& arrivals);

/// For each element, the sum of the form factors of opaque sources by the links at itself and above, as the solution uses them.
std::vector<double> factor_sums(const Solution& solution, const Arrivals& arrivals,
                                std::span<const mesh::ElementId> elements);

}  // namespace clerestory::lighting
