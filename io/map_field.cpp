// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace clerestory::io {

namespace {

/// Samples along each side of a pixel, for smooth borders of the coloured area.
constexpr int kSamples = 2;
/// Rows of pixels that are sampled at once.
constexpr int kBand = 48;
/// How far outside of a quadrilateral a sample still belongs to it, in shares of its sides; closes the joints.
constexpr double kSlack = 1e-6;

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// A convex quadrilateral a, b, c, d over the unit square, with a at (0, 0), b at (1, 0), c at (1, 1).
class BilinearQuad {
 public:
  explicit BilinearQuad(const std::array<Pixel, 4>& q)
      : a_(q[0]),
        u_{q[1].x - q[0].x, q[1].y - q[0].y},
        v_{q[3].x - q[0].x, q[3].y - q[0].y},
        twist_{q[0].x - q[1].x + q[2].x - q[3].x, q[0].y - q[1].y + q[2].y - q[3].y} {
    const double determinant = u_.x * v_.y - u_.y * v_.x;
    if (std::abs(twist_.x) + std::abs(twist_.y) >= kSlack || determinant == 0.0) return;
    parallelogram_ = true;
    to_u_ = {v_.y / determinant, -v_.x / determinant};
    to_v_ = {-u_.y / determinant, u_.x / determinant};
  }

  /// Calls sample(x, (u, v)) for the whole numbers x in [first, end) for which the place (x + 0.5, y) lies inside.
  template <class Sample>
  void in_row(double y, int first, int end, const Sample& sample) const {
    if (!parallelogram_) {
      for (int x = first; x < end; ++x) {
        if (const auto at = place({x + 0.5, y})) sample(x, *at);
      }
      return;
    }
    const Pixel r{0.5 - a_.x, y - a_.y};
    const Pixel start{r.x * to_u_.x + r.y * to_u_.y, r.x * to_v_.x + r.y * to_v_.y};
    const Stretch u = within_unit(start.x, to_u_.x);
    const Stretch v = within_unit(start.y, to_v_.x);
    const int from = static_cast<int>(std::ceil(std::max({static_cast<double>(first), u.from, v.from})));
    const int last = static_cast<int>(std::floor(std::min({static_cast<double>(end - 1), u.to, v.to})));
    for (int x = from; x <= last; ++x) sample(x, Pixel{start.x + x * to_u_.x, start.y + x * to_v_.x});
  }

 private:
  static constexpr int kSteps = 5;

  struct Stretch {
    double from = 0.0;
    double to = 0.0;
  };

  /// The x for which start + x · step lies between 0 and 1.
  static Stretch within_unit(double start, double step) {
    constexpr double kFar = 1e6;
    if (step == 0.0) return start >= -kSlack && start <= 1.0 + kSlack ? Stretch{-kFar, kFar} : Stretch{kFar, -kFar};
    const auto [from, to] = std::minmax({(-kSlack - start) / step, (1.0 + kSlack - start) / step});
    return {std::clamp(from, -kFar, kFar), std::clamp(to, -kFar, kFar)};
  }

  /// The (u, v) of a place by Newton's method; nothing when it lies outside.
  [[nodiscard]] std::optional<Pixel> place(Pixel p) const {
    double u = 0.5;
    double v = 0.5;
    for (int step = 0; step < kSteps; ++step) {
      const double rx = p.x - (a_.x + u * u_.x + v * v_.x + u * v * twist_.x);
      const double ry = p.y - (a_.y + u * u_.y + v * v_.y + u * v * twist_.y);
      const Pixel along_u{u_.x + v * twist_.x, u_.y + v * twist_.y};
      const Pixel along_v{v_.x + u * twist_.x, v_.y + u * twist_.y};
      const double determinant = along_u.x * along_v.y - along_u.y * along_v.x;
      if (determinant == 0.0) return std::nullopt;
      u += (rx * along_v.y - ry * along_v.x) / determinant;
      v += (along_u.x * ry - along_u.y * rx) / determinant;
    }
    const auto in_unit = [](double t) { return t >= -kSlack && t <= 1.0 + kSlack; };
    return in_unit(u) && in_unit(v) ? std::optional(Pixel{u, v}) : std::nullopt;
  }

  Pixel a_;
  Pixel u_;
  Pixel v_;
  Pixel twist_;
  bool parallelogram_ = false;  ///< the inverse is a matrix then
  Pixel to_u_;
  Pixel to_v_;
};

/// A quadrilateral of the map on the raster of samples.
struct FieldQuad {
  std::array<Pixel, 4> corners;  ///< [samples]
  std::array<double, 4> values;
  double top = 0.0;
  double bottom = 0.0;
};

std::vector<FieldQuad> field_quads(const MapMesh& mesh, const MapLayout& layout) {
  std::vector<FieldQuad> quads;
  quads.reserve(mesh.quads.size());
  for (const auto& nodes : mesh.quads) {
    FieldQuad quad;
    for (std::size_t k = 0; k < 4; ++k) {
      const Pixel at = layout.pixel(mesh.nodes[nodes[k]]);
      quad.corners[k] = {kSamples * at.x, kSamples * at.y};
      quad.values[k] = static_cast<double>(mesh.values[nodes[k]]);
    }
    const auto [top, bottom] = std::ranges::minmax(quad.corners, {}, &Pixel::y);
    quad.top = top.y;
    quad.bottom = bottom.y;
    quads.push_back(quad);
  }
  return quads;
}

/// Values of a band of pixels on a raster finer than the picture; kNothing where there are none.
class FieldBand {
 public:
  explicit FieldBand(int width) : width_(kSamples * width) {}

  /// Begins with the rows of pixels in [first, end).
  void begin(int first, int end) {
    first_ = kSamples * first;
    end_ = kSamples * end;
    values_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(end_ - first_), kNothing);
  }

  void fill(const FieldQuad& quad) {
    const int top = std::max(first_, first(quad.top));
    const int bottom = std::min(end_, first(quad.bottom) + 1);
    if (top >= bottom) return;
    const auto [left, right] = std::ranges::minmax(quad.corners, {}, &Pixel::x);
    const BilinearQuad shape(quad.corners);
    for (int y = top; y < bottom; ++y) {
      float* const row = &values_[index(0, y)];
      shape.in_row(y + 0.5, first(left.x), std::min(width_, first(right.x) + 1), [&](int x, Pixel at) {
        const double lower = quad.values[0] + at.x * (quad.values[1] - quad.values[0]);
        const double upper = quad.values[3] + at.x * (quad.values[2] - quad.values[3]);
        row[x] = static_cast<float>(lower + at.y * (upper - lower));
      });
    }
  }

  [[nodiscard]] float at(int x, int y) const { return values_[index(x, y)]; }

 private:
  static int first(double v) { return std::max(0, static_cast<int>(std::ceil(v - 0.5 - kSlack))); }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - first_) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_;
  int first_ = 0;
  int end_ = 0;
  std::vector<float> values_;
};

/// The colours of a scale, each so near to the next that no eye tells them apart.
class Palette {
 public:
  Palette() {
    for (std::size_t i = 0; i < kShades; ++i)
      colours_[i] = map_colour(static_cast<double>(i) / static_cast<double>(kShades - 1));
  }
  [[nodiscard]] Rgb at(double position) const {
    return colours_[static_cast<std::size_t>(position * static_cast<double>(kShades - 1) + 0.5)];
  }

 private:
  static constexpr std::size_t kShades = 4097;  // the control points of map_colour() are among them

  std::array<Rgb, kShades> colours_;
};

/// What a field is painted with.
struct FieldPaint {
  const MapScale& scale;
  Palette palette;
};

/// Gives how much of the pixel is painted.
double paint_pixel(Raster& raster, int x, int y, const FieldBand& field, const FieldPaint& paint, double within) {
  int covered = 0;
  double sum = 0.0;
  for (int j = kSamples * y; j < kSamples * (y + 1); ++j) {
    for (int i = kSamples * x; i < kSamples * (x + 1); ++i) {
      const float value = field.at(i, j);
      if (std::isnan(value)) continue;
      ++covered;
      sum += static_cast<double>(value);
    }
  }
  if (covered == 0) return 0.0;
  const double coverage = within * covered / (kSamples * kSamples);
  raster.blend(x, y, paint.palette.at(paint.scale.position(sum / covered)), coverage);
  return coverage;
}

}  // namespace

Mask field_mask(const MapPlan& plan, const MapLayout& layout) {
  Mask mask(layout.width, layout.height);
  for (const MapOutline& outline : plan.outlines) {
    if (!outline.hole) mask.add_polygon(layout.pixels(outline.loop));
  }
  for (std::size_t i = 0; i < plan.cells.size(); ++i) {
    if (plan.inside[i] != 0) continue;
    const std::vector<Pixel> cell = layout.pixels(plan.cells[i]);
    mask.add_polygon(cell);
    mask.add_line(cell, true, 2.0);  // or the joints between cells would be half covered
  }
  return mask;
}

Mask paint_field(Raster& raster, const MapMesh& mesh, const MapLayout& layout, const MapScale& scale,
                 const Mask& within) {
  const std::vector<FieldQuad> quads = field_quads(mesh, layout);
  const FieldPaint paint{scale, {}};
  FieldBand field(layout.width);
  Mask painted(layout.width, layout.height);
  for (int first = 0; first < layout.height; first += kBand) {
    const int end = std::min(layout.height, first + kBand);
    field.begin(first, end);
    for (const FieldQuad& quad : quads) field.fill(quad);
    for (int y = first; y < end; ++y) {
      within.in_row(y, [&](int x, float coverage) {
        const double here = paint_pixel(raster, x, y, field, paint, static_cast<double>(coverage));
        painted.add(x, y, static_cast<float>(here));
      });
    }
  }
  return painted;
}

}  // namespace clerestory::io
