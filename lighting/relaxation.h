// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "lighting/arrivals.h"
#include "lighting/clusters.h"
#include "lighting/links.h"
#include "lighting/solution.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// What relax() says of itself.
struct Relaxed {
  std::size_t iterations = 0;
  double missing = 0.0;  ///< share of the reflected flux that iterations not made would still change
};

/// In terms of what changes count: of all flux, which mostly may be outdoors, or of the light of each element, on the mean over the
/// elements. From a solution close by the former will do; light that starts from nothing has not come deep into a building by then.
enum class Change { kOfFlux, kOfElements };

/// Gathers over links, with push and pull, until what is missing is far below any accuracy; less far where the progress says that it
/// should finish. Casts no rays.
Relaxed relax(Solution& solution, Clusters& clusters, const Arrivals& arrivals, const Progress& progress,
              Change measure = Change::kOfFlux);

/// Mean radiosity of a source [lm/m²].
double mean_of(const Solution& solution, const Clusters& clusters, LinkSource source);

/// What a receiver may get more or less because parts of the source differ from its line, as far as they are seen under different
/// factors [lux].
/// @param deviation  of the source's radiosity from its line, or from a cluster's mean [lm/m²]
double uneven_light(const mesh::ElementTree& tree, const Link& link, double deviation);

/// Adds the links' errors at their receivers to those of the solution, as the radiosities stand. Errors of different links are
/// independent. Precondition: the arrivals' errors are kept.
void add_link_errors(Solution& solution, const Clusters& clusters, const Arrivals& arrivals);

}  // namespace clerestory::lighting
