// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map_furniture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "io/raster_text.h"

namespace clerestory::io {

namespace {

constexpr Rgb kInk{24, 24, 28};
constexpr Rgb kQuiet{96, 96, 102};
constexpr Rgb kRule{190, 190, 196};
constexpr Rgb kPaper{255, 255, 255};
constexpr Rgb kWarning{176, 32, 16};
constexpr TextStyle kTitle{27, true};
constexpr TextStyle kSubtitle{18, false};
constexpr TextStyle kSmall{14, false};
constexpr TextStyle kFigure{19, true};
constexpr double kLongestBar = 300.0;  // [pixels]

void paint_line(Raster& raster, std::span<const Pixel> line, bool closed, double width, Rgb colour) {
  Mask mask(raster.width(), raster.height());
  mask.add_line(line, closed, width);
  raster.paint(mask, colour);
}

void paint_polygon(Raster& raster, std::span<const Pixel> loop, Rgb colour) {
  Mask mask(raster.width(), raster.height());
  mask.add_polygon(loop);
  raster.paint(mask, colour);
}

void paint_frame(Raster& raster, const PixelRect& box, double width, Rgb colour) {
  const std::array<Pixel, 4> corners{
      {{box.x, box.y}, {box.right(), box.y}, {box.right(), box.bottom()}, {box.x, box.bottom()}}};
  paint_line(raster, corners, true, width, colour);
}

/// Shortens a text that is too wide, with an ellipsis; whole UTF-8 characters are dropped.
std::string fitted(std::string text, TextStyle style, double width) {
  if (render_text(text, style).width <= width) return text;
  while (!text.empty() && render_text(text + "…", style).width > width) {
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) text.pop_back();
    if (!text.empty()) text.pop_back();
  }
  return text + "…";
}

/// Three significant digits: one more than on the map, as befits a mean.
std::string figure_number(double value) {
  return std::abs(value) < 999.5 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

struct Figure {
  std::string label;
  std::string value;
};

std::vector<Figure> figures_of(const lighting::GridResult& grid, std::span<const float> values, MapQuantity quantity) {
  const lighting::GridMetrics& m = grid.metrics;
  const bool factor = quantity == MapQuantity::kDaylightFactor;
  const auto with_unit = [factor](double value) { return figure_number(value) + (factor ? " %" : " lx"); };
  const auto [low, high] = std::ranges::minmax_element(values);
  std::vector<Figure> figures{{"mean", with_unit(factor ? m.mean_df_percent : m.mean_lux)},
                              {"median", with_unit(factor ? m.median_df_percent : m.median_lux)},
                              {"minimum", with_unit(static_cast<double>(*low))},
                              {"maximum", with_unit(static_cast<double>(*high))},
                              {"uniformity (min/mean)", fmt::format("{:.2f}", m.uniformity)}};
  if (factor) {
    figures.push_back({"area with at least 2 %", fmt::format("{:.0f} %", 100.0 * m.share_above_2_percent)});
    figures.push_back({"at least 5 %", fmt::format("{:.0f} %", 100.0 * m.share_above_5_percent)});
  }
  return figures;
}

std::string accuracy_text(const lighting::GridResult& grid, const lighting::Results& results) {
  return fmt::format("{} sensor{}; accuracy {:.2g} % ({:.2g} % asked{})", grid.sensors.count(),
                     grid.sensors.count() == 1 ? "" : "s", 100.0 * grid.metrics.accuracy_reached,
                     100.0 * results.accuracy_target, grid.metrics.accuracy_met ? "" : "; NOT REACHED");
}

}  // namespace

std::string quantity_title(MapQuantity quantity) {
  return quantity == MapQuantity::kDaylightFactor ? "Daylight factor [%]" : "Illuminance [lx]";
}

void draw_title(Raster& raster, const MapLayout& layout, const MapPlan& plan, const lighting::GridResult& grid,
                MapQuantity quantity, const ResultContext& context) {
  const double width = layout.width - 2.0 * layout.title.x;
  const std::string title = context.study_name.empty() ? grid.name : context.study_name;
  draw_text(raster, fitted(title, kTitle, width), kTitle, layout.title, {}, kInk);
  const std::string where = plan.panels.size() == 1 ? ", " + plan.panels.front().caption : "";
  const std::string when = grid.moment.empty() ? "" : ", " + grid.moment;
  const std::string subtitle = quantity_title(quantity) + "  ·  grid " + grid.name + when + where;
  draw_text(raster, fitted(subtitle, kSubtitle, width), kSubtitle, {layout.title.x, layout.title.y + 40.0}, {}, kQuiet);
}

void draw_legend(Raster& raster, const MapLayout& layout, const MapScale& scale, MapQuantity quantity) {
  const PixelRect& bar = layout.legend;
  const bool factor = quantity == MapQuantity::kDaylightFactor;
  draw_text(raster, factor ? "Daylight factor" : "Illuminance", {16, true}, {bar.x, bar.y - 46.0}, {}, kInk);
  draw_text(raster, factor ? "[%]" : "[lx]", {16, false}, {bar.x, bar.y - 24.0}, {}, kInk);
  const int rows = static_cast<int>(std::lround(bar.height));
  for (int row = 0; row < rows; ++row) {
    const double position = 1.0 - (row + 0.5) / rows;
    raster.fill({bar.x, std::round(bar.y) + row, bar.width, 1.0}, map_colour(position));
  }
  paint_frame(raster, {bar.x, std::round(bar.y), bar.width, static_cast<double>(rows)}, 1.2, kInk);
  for (const double knot : scale.knots) {
    const double y = std::round(bar.y) + rows * (1.0 - scale.position(knot));
    const std::array<Pixel, 2> tick{{{bar.right(), y}, {bar.right() + 7.0, y}}};
    paint_line(raster, tick, false, 1.2, kInk);
    draw_text(raster, knot_label(knot), {15, false}, {bar.right() + 13.0, y}, {Align::kStart, Align::kMiddle}, kInk);
  }
}

void draw_scale_bar(Raster& raster, const MapLayout& layout) {
  const double bar_m = round_step(kLongestBar / layout.pixels_per_metre);
  const double width = bar_m * layout.pixels_per_metre;
  const int parts = std::abs(bar_m / std::pow(10.0, std::floor(std::log10(bar_m) + 1e-9)) - 2.0) < 1e-6 ? 4 : 5;
  const Pixel at = layout.scale_bar;
  for (int i = 0; i < parts; ++i) {
    const PixelRect part{at.x + width * i / parts, at.y, width / parts, 8.0};
    raster.fill(part, i % 2 == 0 ? kInk : kPaper);
  }
  paint_frame(raster, {at.x, at.y, width, 8.0}, 1.2, kInk);
  for (const double share : {0.0, 0.5, 1.0}) {
    if (share == 0.5 && parts % 2 == 1) continue;  // no joint there
    const std::string label = knot_label(share * bar_m) + (share == 1.0 ? " m" : "");
    const double x = at.x + share * width;
    draw_text(raster, label, kSmall, {x, at.y + 13.0}, {Align::kMiddle, Align::kStart}, kInk);
  }
}

void draw_north(Raster& raster, const MapLayout& layout, const MapPoint& north) {
  const Pixel c = layout.north;
  const auto place = [&](double forward, double right) {
    // On the picture y runs down: north is (x, -y), and its right hand (y, x).
    return Pixel{c.x + forward * north.x + right * north.y, c.y - forward * north.y + right * north.x};
  };
  const Pixel tip = place(34.0, 0.0);
  const Pixel notch = place(-12.0, 0.0);
  const std::array<Pixel, 3> left{{tip, place(-24.0, -15.0), notch}};
  const std::array<Pixel, 3> right{{tip, place(-24.0, 15.0), notch}};
  paint_polygon(raster, left, kInk);
  paint_polygon(raster, right, kPaper);
  paint_line(raster, left, true, 1.3, kInk);
  paint_line(raster, right, true, 1.3, kInk);
  draw_text(raster, "N", {17, true}, place(47.0, 0.0), {Align::kMiddle, Align::kMiddle}, kInk);
}

void draw_footer(Raster& raster, const MapLayout& layout, const lighting::GridResult& grid,
                 const lighting::Results& results, std::span<const float> values, MapQuantity quantity,
                 const ResultContext& context) {
  const PixelRect& box = layout.footer;
  raster.fill({box.x, box.y, box.width, 1.0}, kRule);
  double x = box.x;
  for (const Figure& figure : figures_of(grid, values, quantity)) {
    const PixelRect label = draw_text(raster, figure.label, kSmall, {x, box.y + 14.0}, {}, kQuiet);
    const PixelRect value = draw_text(raster, figure.value, kFigure, {x, box.y + 34.0}, {}, kInk);
    x = std::max(label.right(), value.right()) + 44.0;
  }
  draw_text(raster, fitted(accuracy_text(grid, results), kSmall, box.width), kSmall, {box.x, box.y + 74.0}, {},
            grid.metrics.accuracy_met ? kQuiet : kWarning);
  const std::string origin =
      (context.sky.empty() ? std::string{} : context.sky + "  ·  ") + "Clerestory " + context.version;
  draw_text(raster, fitted(origin, kSmall, box.width), kSmall, {box.x, box.y + 96.0}, {}, kQuiet);
}

}  // namespace clerestory::io
