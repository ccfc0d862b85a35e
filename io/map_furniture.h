// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "io/map_layout.h"
#include "io/map_scale.h"
#include "io/raster.h"
#include "io/result_context.h"
#include "lighting/results.h"

namespace clerestory::io {

/// "Daylight factor [%]" or "Illuminance [lx]".
std::string quantity_title(MapQuantity quantity);

/// The study, the grid, what is shown and where.
void draw_title(Raster& raster, const MapLayout& layout, const MapPlan& plan, const lighting::GridResult& grid,
                MapQuantity quantity, const ResultContext& context);

/// The colours with the values of the knots.
void draw_legend(Raster& raster, const MapLayout& layout, const MapScale& scale, MapQuantity quantity);

/// A bar of a round number of metres, in the scale of the plan.
void draw_scale_bar(Raster& raster, const MapLayout& layout);

/// An arrow to the north of the plan.
void draw_north(Raster& raster, const MapLayout& layout, const MapPoint& north);

/// The figures of the grid, the accuracy, the sky and the program.
void draw_footer(Raster& raster, const MapLayout& layout, const lighting::GridResult& grid,
                 const lighting::Results& results, std::span<const float> values, MapQuantity quantity,
                 const ResultContext& context);

}  // namespace clerestory::io
