// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "mesh/model.h"

namespace clerestory::support {

/// What is done to a clean model. Shares are of polygons, of `unwelded` of the corners [0 … 1].
struct Damage {
  double jitter_m = 0.0;    ///< vertices are displaced by up to this along each axis
  double duplicated = 0.0;  ///< are there twice, the copy at the end, from another corner on
  double flipped = 0.0;     ///< are wound the other way round
  double split =
      0.0;  ///< get a corner in the middle of a side, that their neighbours do not have, displaced with the jitter
  double unwelded = 0.0;  ///< get a vertex of their own, displaced like all
};

/// The model with damage by a rule that depends on the seed alone. Areas change by the jitter alone, but for copies.
mesh::Model vandalised(const mesh::Model& model, const Damage& damage, std::uint32_t seed);

}  // namespace clerestory::support
