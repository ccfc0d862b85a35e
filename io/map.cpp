// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map.h"

#include <span>

#include "io/map_field.h"
#include "io/map_furniture.h"
#include "io/map_labels.h"
#include "io/map_layout.h"
#include "io/map_mesh.h"
#include "io/map_no_sky.h"
#include "io/map_plan.h"
#include "io/map_scale.h"
#include "io/raster.h"
#include "io/raster_text.h"
#include "io/whole_file.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr Rgb kPaper{255, 255, 255};
constexpr Rgb kRoom{236, 236, 238};  // where a room has no sensors
constexpr Rgb kWall{64, 64, 68};
constexpr Rgb kQuiet{96, 96, 102};

void paint_rooms(Raster& raster, const MapPlan& plan, const MapLayout& layout) {
  Mask rooms(layout.width, layout.height);
  for (const MapOutline& outline : plan.outlines) {
    if (!outline.hole) rooms.add_polygon(layout.pixels(outline.loop));
  }
  raster.paint(rooms, kRoom);
}

void draw_outlines(Raster& raster, Occupied& occupied, const MapPlan& plan, const MapLayout& layout) {
  Mask walls(layout.width, layout.height);
  for (const MapOutline& outline : plan.outlines) {
    walls.add_line(layout.pixels(outline.loop), true, outline.hole ? 1.2 : 3.0);
  }
  raster.paint(walls, kWall);
  occupied.take(walls);
}

void draw_captions(Raster& raster, const MapPlan& plan, const MapLayout& layout) {
  for (const MapPanel& panel : plan.panels) {
    const Pixel at = layout.pixel({panel.box.low.x, panel.box.high.y});
    draw_text(raster, panel.caption, {14, true}, {at.x, at.y - 6.0}, {Align::kStart, Align::kEnd}, kQuiet);
  }
}

void draw_plan(Raster& raster, const MapPlan& plan, const MapLayout& layout, const MapScale& scale,
               std::span<const float> values) {
  Occupied occupied(layout.width, layout.height);
  paint_rooms(raster, plan, layout);
  if (plan.cells.empty()) {
    draw_outlines(raster, occupied, plan, layout);
    draw_dots(raster, occupied, plan, layout, values, scale);
    draw_values(raster, occupied, plan, layout, values, Mask(0, 0));
  } else {
    const MapMesh mesh = interpolate(plan, values);
    const Mask within = field_mask(plan, layout);
    const Mask painted = paint_field(raster, mesh, layout, scale, within);
    draw_outlines(raster, occupied, plan, layout);
    draw_no_sky(raster, occupied, plan, layout);
    draw_isolines(raster, occupied, mesh, layout, scale, within);
    draw_values(raster, occupied, plan, layout, values, painted);
  }
}

}  // namespace

void write_map_png(const std::filesystem::path& file, const lighting::GridResult& grid,
                   const lighting::Results& results, const ResultContext& context) {
  if (grid.sensors.count() == 0) {
    throw InputError("", 0, "grid '" + grid.name + "' has no sensors to draw", "give it surfaces or points");
  }
  const bool factor = !grid.daylight_factor_percent.empty();
  const MapQuantity quantity = factor ? MapQuantity::kDaylightFactor : MapQuantity::kIlluminance;
  const std::vector<float>& values = factor ? grid.daylight_factor_percent : grid.illuminance_lux;
  const MapPlan plan = lay_flat(grid.sensors, context.north_deg, grid.no_sky);
  const MapLayout layout = layout_map(plan);
  const MapScale scale = choose_scale(values, quantity);
  Raster raster(layout.width, layout.height, kPaper);
  draw_plan(raster, plan, layout, scale, values);
  if (plan.panels.size() > 1) draw_captions(raster, plan, layout);
  draw_title(raster, layout, plan, grid, quantity, context);
  draw_legend(raster, layout, scale, quantity);
  draw_scale_bar(raster, layout);
  if (plan.seen_from_above) draw_north(raster, layout, plan.north);
  draw_footer(raster, layout, grid, results, values, quantity, context);
  write_whole_file(file, raster.png());
}

}  // namespace clerestory::io
