// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/map_layout.h"
#include "io/raster.h"

namespace clerestory::io {

/// Draws the lines beyond which there is no sky to be seen, with their name where there is room; what they take is marked.
void draw_no_sky(Raster& raster, Occupied& occupied, const MapPlan& plan, const MapLayout& layout);

}  // namespace clerestory::io
