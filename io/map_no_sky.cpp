// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map_no_sky.h"

#include <array>
#include <cmath>

#include "io/raster_text.h"

namespace clerestory::io {

namespace {

constexpr Rgb kSkyLine{16, 52, 140};
constexpr Rgb kPaper{255, 255, 255};
constexpr TextStyle kStyle{15, true};
constexpr double kWidth = 2.4;   // [pixels]
constexpr double kClear = 5.0;   // between line and name [pixels]
constexpr double kHalo = 2.5;    // [pixels]
constexpr double kTried = 0.25;  // shares of the line at which the name is tried

/// Prints the name beside a line, at the first of some places that is free.
bool draw_name(Raster& raster, Occupied& occupied, const Pixel& a, const Pixel& b) {
  const TextImage name = render_text("no-sky", kStyle);
  const bool level = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
  for (const double share : {0.5, 0.5 - kTried, 0.5 + kTried}) {
    for (const double side : {-1.0, 1.0}) {
      const Pixel at{a.x + share * (b.x - a.x) + (level ? 0.0 : side * kClear),
                     a.y + share * (b.y - a.y) + (level ? side * kClear : 0.0)};
      const Align towards = side < 0.0 ? Align::kEnd : Align::kStart;
      const PixelRect box =
          text_box(name, at, level ? TextAnchor{Align::kMiddle, towards} : TextAnchor{towards, Align::kMiddle});
      if (!occupied.free(box)) continue;
      draw_halo(raster, name, box, kPaper, kHalo);
      draw_text(raster, name, box, kSkyLine);
      occupied.take(box);
      return true;
    }
  }
  return false;
}

}  // namespace

void draw_no_sky(Raster& raster, Occupied& occupied, const MapPlan& plan, const MapLayout& layout) {
  if (plan.no_sky.empty()) return;
  Mask lines(layout.width, layout.height);
  for (const auto& line : plan.no_sky) {
    const std::array<Pixel, 2> ends{layout.pixel(line[0]), layout.pixel(line[1])};
    lines.add_line(ends, false, kWidth);
  }
  raster.paint(lines, kSkyLine);
  occupied.take(lines);
  for (const auto& line : plan.no_sky) {
    if (draw_name(raster, occupied, layout.pixel(line[0]), layout.pixel(line[1]))) return;
  }
}

}  // namespace clerestory::io
