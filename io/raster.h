// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace clerestory::io {

/// A colour as sRGB [0 … 255].
struct Rgb {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  constexpr bool operator==(const Rgb&) const = default;
};

/// How light a colour looks [0 … 1]: Rec. 709 luma of the encoded values.
double lightness(Rgb colour);

/// A place on a raster [pixels], from the upper left corner to the right and down; pixel (0, 0) has its centre at
/// (0.5, 0.5).
struct Pixel {
  double x = 0.0;
  double y = 0.0;
};

/// A rectangle on a raster [pixels].
struct PixelRect {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;

  [[nodiscard]] double right() const { return x + width; }
  [[nodiscard]] double bottom() const { return y + height; }
  [[nodiscard]] PixelRect grown(double by) const { return {x - by, y - by, width + 2.0 * by, height + 2.0 * by}; }
};

/// How much of each pixel a shape covers [0 … 1]. What is added joins what is there; what lies outside is dropped.
class Mask {
 public:
  Mask(int width, int height);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] float at(int x, int y) const {
    const std::uint32_t first = first_[stretch(x, y)];
    return first == kNone ? 0.0F : coverage_[first + static_cast<std::size_t>(x % kStretch)];
  }
  /// Calls visit(x, coverage) for the pixels of a row that are covered, from the left to the right.
  template <class Visit>
  void in_row(int y, const Visit& visit) const {
    for (int x = 0; x < width_; x += kStretch) {
      const std::uint32_t first = first_[stretch(x, y)];
      if (first == kNone) continue;
      for (int i = 0; i < kStretch; ++i) {
        if (const float here = coverage_[first + static_cast<std::size_t>(i)]; here > 0.0F) visit(x + i, here);
      }
    }
  }

  /// A line of the given width [pixels] with round joints and ends.
  void add_line(std::span<const Pixel> line, bool closed, double line_width);
  /// The inside of a loop, even-odd where it crosses itself.
  void add_polygon(std::span<const Pixel> loop);
  void add_disc(Pixel centre, double radius);
  /// Joins one pixel.
  void add(int x, int y, float coverage);

  /// Keeps of this mask what the other one covers too.
  void keep_inside(const Mask& other);

 private:
  static constexpr int kStretch = 64;  ///< pixels of a row that come together
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  [[nodiscard]] std::size_t stretch(int x, int y) const {
    return static_cast<std::size_t>(y) * in_row_ + static_cast<std::size_t>(x / kStretch);
  }
  void add_segment(Pixel a, Pixel b, double line_width);
  void add_scanline(std::span<const Pixel> loop, double y, std::vector<float>& row, std::vector<double>& crossings);

  int width_;
  int height_;
  std::size_t in_row_;  ///< stretches of a row
  std::vector<std::uint32_t>
      first_;  ///< [stretches, row by row] where its pixels begin; kNone until touched: most shapes are small
  std::vector<float> coverage_;  ///< of the stretches that are there
};

/// A picture in memory, painted in layers.
class Raster {
 public:
  Raster(int width, int height, Rgb background);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Rgb at(int x, int y) const { return pixels_[index(x, y)]; }

  /// Mixes a colour into one pixel; coverage [0 … 1]. Pixels outside are ignored.
  void blend(int x, int y, Rgb colour, double coverage);
  /// Mixes a colour in where the mask covers.
  void paint(const Mask& mask, Rgb colour, double opacity = 1.0);
  /// Fills the pixels whose centres lie in a rectangle.
  void fill(const PixelRect& rectangle, Rgb colour);

  /// The picture as a PNG file. Throws MachineError when it cannot be encoded.
  [[nodiscard]] std::string png() const;

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  std::vector<Rgb> pixels_;
};

}  // namespace clerestory::io
