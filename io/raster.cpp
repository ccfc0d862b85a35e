// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/raster.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <png.h>

#include "mesh/error.h"

namespace clerestory::io {

namespace {

/// Rows of samples within a pixel, for the edges of polygons that are nearly level.
constexpr int kScanlinesPerPixel = 4;

/// First and last pixel whose centre may lie in [low, high], within [0, size).
struct PixelRange {
  PixelRange(double low, double high, int size)
      : first(static_cast<int>(std::clamp(std::floor(low), 0.0, static_cast<double>(size)))),
        last(static_cast<int>(std::clamp(std::ceil(high), -1.0, static_cast<double>(size - 1)))) {}
  int first;
  int last;
};

double squared_distance_to_segment(Pixel p, Pixel a, Pixel b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double square = dx * dx + dy * dy;
  const double t = square > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
  const double x = p.x - a.x - t * dx;
  const double y = p.y - a.y - t * dy;
  return x * x + y * y;
}

/// Adds the share of each pixel of a row that lies in [from, to].
void add_span(std::vector<float>& row, double from, double to, double weight) {
  const double end = static_cast<double>(row.size());
  from = std::clamp(from, 0.0, end);
  to = std::clamp(to, 0.0, end);
  if (from >= to) return;
  const auto first = static_cast<std::size_t>(from);
  const auto last = static_cast<std::size_t>(to);
  if (first == last) {
    row[first] += static_cast<float>(weight * (to - from));
    return;
  }
  row[first] += static_cast<float>(weight * (static_cast<double>(first + 1) - from));
  for (std::size_t x = first + 1; x < last; ++x) row[x] += static_cast<float>(weight);
  if (last < row.size()) row[last] += static_cast<float>(weight * (to - static_cast<double>(last)));
}

/// @param share  of the colour above [0 … 1]
void mix(Rgb& below, Rgb above, double share) {
  if (share >= 1.0) {
    below = above;
    return;
  }
  const auto mixed = [share](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>((1.0 - share) * a + share * b + 0.5);  // rounds
  };
  below = {mixed(below.r, above.r), mixed(below.g, above.g), mixed(below.b, above.b)};
}

}  // namespace

double lightness(Rgb colour) { return (0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b) / 255.0; }

Mask::Mask(int width, int height)
    : width_(width),
      height_(height),
      in_row_(static_cast<std::size_t>((width + kStretch - 1) / kStretch)),
      first_(in_row_ * static_cast<std::size_t>(height), kNone) {}

void Mask::add(int x, int y, float coverage) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  if (coverage <= 0.0F) return;
  std::uint32_t& first = first_[stretch(x, y)];
  if (first == kNone) {
    first = static_cast<std::uint32_t>(coverage_.size());
    coverage_.resize(coverage_.size() + kStretch);
  }
  float& here = coverage_[first + static_cast<std::size_t>(x % kStretch)];
  here = std::max(here, coverage);
}

void Mask::add_segment(Pixel a, Pixel b, double line_width) {
  const double reach = 0.5 * line_width + 0.5;
  const PixelRange rows(std::min(a.y, b.y) - reach, std::max(a.y, b.y) + reach, height_);
  const PixelRange columns(std::min(a.x, b.x) - reach, std::max(a.x, b.x) + reach, width_);
  for (int y = rows.first; y <= rows.last; ++y) {
    for (int x = columns.first; x <= columns.last; ++x) {
      const double square = squared_distance_to_segment({x + 0.5, y + 0.5}, a, b);
      if (square < reach * reach) add(x, y, static_cast<float>(std::min(reach - std::sqrt(square), 1.0)));
    }
  }
}

void Mask::add_line(std::span<const Pixel> line, bool closed, double line_width) {
  for (std::size_t i = 1; i < line.size(); ++i) add_segment(line[i - 1], line[i], line_width);
  if (closed && line.size() > 2) add_segment(line.back(), line.front(), line_width);
}

void Mask::add_disc(Pixel centre, double radius) { add_segment(centre, centre, 2.0 * radius); }

void Mask::add_scanline(std::span<const Pixel> loop, double y, std::vector<float>& row,
                        std::vector<double>& crossings) {
  crossings.clear();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Pixel& a = loop[i];
    const Pixel& b = loop[(i + 1) % loop.size()];
    if ((a.y <= y) != (b.y <= y)) crossings.push_back(a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y));
  }
  std::ranges::sort(crossings);
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    add_span(row, crossings[i], crossings[i + 1], 1.0 / kScanlinesPerPixel);
  }
}

void Mask::add_polygon(std::span<const Pixel> loop) {
  if (loop.size() < 3) return;
  const auto [low, high] = std::ranges::minmax_element(loop, {}, &Pixel::y);
  const PixelRange rows(low->y, high->y, height_);
  const auto [left, right] = std::ranges::minmax_element(loop, {}, &Pixel::x);
  const PixelRange columns(left->x, right->x, width_);
  if (columns.last < columns.first) return;
  std::vector<float> covered(static_cast<std::size_t>(width_));
  std::vector<double> crossings;
  for (int y = rows.first; y <= rows.last; ++y) {
    std::fill(covered.begin() + columns.first, covered.begin() + columns.last + 1, 0.0F);
    for (int s = 0; s < kScanlinesPerPixel; ++s)
      add_scanline(loop, y + (s + 0.5) / kScanlinesPerPixel, covered, crossings);
    for (int x = columns.first; x <= columns.last; ++x) add(x, y, std::min(covered[static_cast<std::size_t>(x)], 1.0F));
  }
}

void Mask::keep_inside(const Mask& other) {
  assert(width_ == other.width_ && height_ == other.height_);
  for (std::size_t s = 0; s < first_.size(); ++s) {
    if (other.first_[s] == kNone) first_[s] = kNone;
    if (first_[s] == kNone) continue;
    for (std::size_t i = 0; i < kStretch; ++i) coverage_[first_[s] + i] *= other.coverage_[other.first_[s] + i];
  }
}

Raster::Raster(int width, int height, Rgb background)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background) {}

void Raster::blend(int x, int y, Rgb colour, double coverage) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_ || coverage <= 0.0) return;
  mix(pixels_[index(x, y)], colour, coverage);
}

void Raster::paint(const Mask& mask, Rgb colour, double opacity) {
  for (int y = 0; y < std::min(height_, mask.height()); ++y) {
    mask.in_row(y, [&](int x, float coverage) { blend(x, y, colour, static_cast<double>(coverage) * opacity); });
  }
}

void Raster::fill(const PixelRect& rectangle, Rgb colour) {
  const int left = static_cast<int>(std::lround(rectangle.x));
  const int top = static_cast<int>(std::lround(rectangle.y));
  const int right = static_cast<int>(std::lround(rectangle.right()));
  const int bottom = static_cast<int>(std::lround(rectangle.bottom()));
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) blend(x, y, colour, 1.0);
  }
}

/// Without filters: maps of a smooth field get smaller by them at the highest levels of compression alone, and at any take four times longer.
std::string Raster::png() const {
  static_assert(sizeof(Rgb) == 3);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_);
  image.height = static_cast<png_uint_32>(height_);
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels_.data(), 0, nullptr) == 0) {
    throw MachineError(std::string("a picture cannot be encoded as PNG: ") + image.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace clerestory::io
