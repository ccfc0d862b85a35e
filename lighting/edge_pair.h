// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/element_tree.h"

namespace clerestory::lighting {

/// The part of a pair of straight edges in the contour integral of two polygons' exchange area [Sparrow 1963; Schröder, Hanrahan 1993]:
/// e_p·e_q ∬ ln r over their lengths, e being unit directions [m²]. In closed form for parallel edges and for edges of one plane,
/// so that edges which touch, or are shared, are exact; the rest of skew edges, and edges that are far from each other, by Gauss-Legendre points:
/// right to 1e-7 of the product of their lengths, of edges that are parallel but for an angle of some 1e-5 to 1e-5 of it.
double edge_pair_integral(const mesh::OutlineEdge& p, const mesh::OutlineEdge& q);

}  // namespace clerestory::lighting
