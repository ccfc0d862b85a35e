// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lighting/scene.h"

namespace clerestory::lighting {

/// Decides which passable faces are sampled openings and which way they look, by the share of the outside that rays from either
/// side see, and tells the rays. Panes between equally dark spaces are no openings: rays just pass them.
void find_openings(Scene& scene);

/// The bounding rectangle of an opening in its plane, facing inwards, as an end of shafts.
mesh::ShaftEnd shaft_end(const Opening& opening);

}  // namespace clerestory::lighting
