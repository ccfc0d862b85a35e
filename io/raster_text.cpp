// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/raster_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include "mesh/error.h"

namespace clerestory::io {

namespace {

/// The font file, or nothing. VTK's own font would do but for Greek and for brackets, which it draws round.
std::string font_file(bool bold) {
  const std::string name = bold ? "DejaVuSans-Bold.ttf" : "DejaVuSans.ttf";
  for (const char* folder : {"/usr/share/fonts/truetype/dejavu/", "/usr/share/fonts/TTF/",
                             "/usr/share/fonts/dejavu-sans-fonts/", "/usr/share/fonts/dejavu/"}) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(folder + name, ignored)) return folder + name;
  }
  return {};
}

void apply(TextStyle style, vtkTextProperty* property) {
  static const std::string kRegular = font_file(false);
  static const std::string kBold = font_file(true);
  const std::string& file = style.bold ? kBold : kRegular;
  if (file.empty()) {
    property->SetFontFamilyToArial();
    property->SetBold(style.bold ? 1 : 0);
  } else {
    property->SetFontFamily(VTK_FONT_FILE);
    property->SetFontFile(file.c_str());
  }
  property->SetFontSize(style.size_px);
  property->SetColor(1.0, 1.0, 1.0);
  property->SetJustificationToLeft();
  property->SetVerticalJustificationToBottom();
}

std::string printable(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  return text.empty() ? " " : text;
}

double shift(Align align, double size) {
  switch (align) {
    case Align::kStart:
      return 0.0;
    case Align::kMiddle:
      return 0.5 * size;
    case Align::kEnd:
      return size;
  }
  return 0.0;
}

}  // namespace

TextImage render_text(const std::string& text, TextStyle style) {
  vtkNew<vtkTextProperty> property;
  apply(style, property);
  vtkNew<vtkImageData> image;
  int size[2] = {0, 0};
  constexpr int kDpi = 72;  // so that a point is a pixel
  vtkTextRenderer* const renderer = vtkTextRenderer::GetInstance();
  if (renderer == nullptr ||
      !renderer->RenderString(property, vtkStdString(printable(text)), image, size, kDpi, vtkTextRenderer::FreeType)) {
    throw MachineError("text cannot be drawn: FreeType failed");
  }
  const int* const extent = image->GetExtent();
  TextImage result;
  result.width = std::min(size[0], extent[1] - extent[0] + 1);
  result.height = std::min(size[1], extent[3] - extent[2] + 1);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {  // VTK counts rows upwards
      const auto* rgba = static_cast<const unsigned char*>(
          image->GetScalarPointer(extent[0] + x, extent[2] + result.height - 1 - y, extent[4]));
      result.ink.push_back(rgba[3]);
    }
  }
  return result;
}

PixelRect text_box(const TextImage& text, Pixel at, TextAnchor anchor) {
  return {std::round(at.x - shift(anchor.horizontal, text.width)),
          std::round(at.y - shift(anchor.vertical, text.height)), static_cast<double>(text.width),
          static_cast<double>(text.height)};
}

void draw_text(Raster& raster, const TextImage& text, const PixelRect& box, Rgb colour) {
  const int left = static_cast<int>(box.x);
  const int top = static_cast<int>(box.y);
  std::size_t i = 0;
  for (int y = 0; y < text.height; ++y) {
    for (int x = 0; x < text.width; ++x) raster.blend(left + x, top + y, colour, text.ink[i++] / 255.0);
  }
}

void draw_halo(Raster& raster, const TextImage& text, const PixelRect& box, Rgb colour, double radius_px) {
  const int reach = static_cast<int>(std::ceil(radius_px));
  const int width = text.width + 2 * reach;
  Mask mask(width, text.height + 2 * reach);
  std::size_t i = 0;
  for (int y = 0; y < text.height; ++y) {
    for (int x = 0; x < text.width; ++x) {
      // A dot of the pen round each pixel that is ink: dilation.
      if (text.ink[i++] > 96) mask.add_disc({x + reach + 0.5, y + reach + 0.5}, radius_px - 0.5);
    }
  }
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < width; ++x) {
      raster.blend(static_cast<int>(box.x) + x - reach, static_cast<int>(box.y) + y - reach, colour,
                   static_cast<double>(mask.at(x, y)));
    }
  }
}

PixelRect draw_text(Raster& raster, const std::string& text, TextStyle style, Pixel at, TextAnchor anchor, Rgb colour) {
  const TextImage image = render_text(text, style);
  const PixelRect box = text_box(image, at, anchor);
  draw_text(raster, image, box, colour);
  return box;
}

}  // namespace clerestory::io
