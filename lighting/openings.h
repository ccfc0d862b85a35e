// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/receiver.h"
#include "lighting/scene.h"

namespace clerestory::lighting {

/// Decides which passable faces are sampled openings and which way they look, by the share of the outside that rays from either
/// side see, and tells the rays. Panes between equally dark spaces are no openings: rays just pass them.
void find_openings(Scene& scene);

/// The bounding rectangle of an opening in its plane, facing inwards, as an end of shafts.
mesh::ShaftEnd shaft_end(const Opening& opening);

/// What an opening gives a point if nothing stands before it and all of it shows the sky, or the ground below [lux].
/// @param opening  shaft_end() of it
double full_through(const Scene& scene, const mesh::ShaftEnd& opening, const mesh::Point& at, const Receiver& receiver);

/// What an opening gives a point if all of it that is not proven hidden shows the sky, or the ground below [lux].
/// @param opening  shaft_end() of it
double most_through(const Scene& scene, const mesh::ShaftEnd& opening, const mesh::Point& at, const Receiver& receiver);

}  // namespace clerestory::lighting
