// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
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
  mesh::ShaftEnd end;     ///< holds all of it
  /// Convex polygons that it consists of: its outline, where that is one, or else its triangles.
  std::vector<mesh::ShaftEnd> pieces;
};

/// All regions of face sides that shine, in order of their roots.
std::vector<Emitter> emitters(const Solution& solution);

/// Form factor of a point to an emitter if nothing stood before it.
double full_factor(const Solution& solution, const Emitter& emitter, const mesh::Point& at, const Receiver& receiver);

/// What the point sees of an emitter past what stands before it, by clipping.
/// @param full  as full_factor() gives it
SeenFactor seen_factor(const Solution& solution, const Emitter& emitter, double full, const mesh::Point& at,
                       const Receiver& receiver);

/// An emitter that may be seen, and whether all of it is proven to be.
struct EmitterInSight {
  const Emitter* emitter = nullptr;
  bool wholly = false;
};
/// Those of some emitters that are not proven to be hidden from all points of a piece.
/// @param emitters  kept by reference
/// @param asked     numbers of those that are asked for
std::vector<EmitterInSight> in_sight(const Solution& solution, std::span<const Emitter> emitters,
                                     std::span<const std::uint32_t> asked, const mesh::ShaftEnd& from);

/// A ray from a point to one place on an emitter: the kernel of the form factor there [1/m²], and the share of it that arrives.
struct EmitterSample {
  double kernel = 0.0;
  double passed = 0.0;
};
EmitterSample sample(const Solution& solution, const Emitter& emitter, const mesh::Point& at, const Receiver& receiver,
                     double a, double b);

}  // namespace clerestory::lighting
