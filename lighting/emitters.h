// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lighting/receiver.h"
#include "lighting/seen_factor.h"
#include "lighting/solution.h"
#include "mesh/ids.h"
#include "mesh/shafts.h"

namespace clerestory::lighting {

/// A surface that shines, as points see it.
struct Emitter {
  mesh::ElementId root;
  double exitance = 0.0;  ///< luminance-weighted [lm/m²]
  mesh::ShaftEnd end;
};

/// All regions of face sides that shine, in order of their roots.
std::vector<Emitter> emitters(const Solution& solution);

/// Form factor of a point to an emitter, and how much of it is proven to be seen; kHidden as well where the factor is next to nothing.
struct EmitterView {
  double factor = 0.0;
  mesh::Visibility visibility = mesh::Visibility::kHidden;
};
EmitterView look(const Solution& solution, const Emitter& emitter, const mesh::Point& at, const Receiver& receiver);

/// What the point sees of an emitter, given the view of it: by clipping, where that proves neither that all of it is seen nor that none is.
SeenFactor seen_factor(const Solution& solution, const Emitter& emitter, const EmitterView& view, const mesh::Point& at,
                       const Receiver& receiver);

/// A ray from a point to one place on an emitter: the kernel of the form factor there [1/m²], and the share of it that arrives.
struct EmitterSample {
  double kernel = 0.0;
  double passed = 0.0;
};
EmitterSample sample(const Solution& solution, const Emitter& emitter, const mesh::Point& at, const Receiver& receiver,
                     double a, double b);

}  // namespace clerestory::lighting
