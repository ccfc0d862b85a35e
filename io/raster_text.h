// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "io/raster.h"

namespace clerestory::io {

struct TextStyle {
  int size_px = 15;
  bool bold = false;
};

/// A line of text, rendered: how much of each pixel is ink [0 … 255], row by row from the top.
/// Texts of one style have the same height, but for accents on capitals, so that their baselines meet where their boxes do.
struct TextImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> ink;
};

/// Renders UTF-8 text in DejaVu Sans (fonts-dejavu-core), or in VTK's own font where that is missing. Control characters
/// become spaces. Needs no display. Throws MachineError when FreeType fails.
TextImage render_text(const std::string& text, TextStyle style);

/// Which point of the text's box an anchor is.
enum class Align { kStart, kMiddle, kEnd };
struct TextAnchor {
  Align horizontal = Align::kStart;  ///< start is left
  Align vertical = Align::kStart;    ///< start is top
};

/// The box of a rendered text at an anchor, on whole pixels.
PixelRect text_box(const TextImage& text, Pixel at, TextAnchor anchor);

/// Paints a rendered text with its upper left corner at the box's.
void draw_text(Raster& raster, const TextImage& text, const PixelRect& box, Rgb colour);

/// Paints a soft-edged outline of a text, before the text itself, so that it can be read on any ground.
void draw_halo(Raster& raster, const TextImage& text, const PixelRect& box, Rgb colour, double radius_px);

/// Renders and paints; returns the box.
PixelRect draw_text(Raster& raster, const std::string& text, TextStyle style, Pixel at, TextAnchor anchor, Rgb colour);

}  // namespace clerestory::io
