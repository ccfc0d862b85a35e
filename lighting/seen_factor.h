// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/receiver.h"
#include "mesh/geometry.h"
#include "mesh/shafts.h"

namespace clerestory::lighting {

/// How much a point sees of a planar polygon past opaque faces, as a form factor.
struct SeenFactor {
  double factor = 0.0;
  bool exact = true;  ///< false: no more than that, as panes or a crowd stand before it
};

/// Clips a polygon by what stands before it [mesh/seen_parts.h].
/// @param polygon  counter-clockwise as seen from the tip of its normal
SeenFactor seen_factor(const mesh::Shafts& shafts, const mesh::Point& at, const Receiver& receiver,
                       const mesh::ShaftEnd& polygon);

}  // namespace clerestory::lighting
