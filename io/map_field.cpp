// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace clerestory::io {

namespace {

/// Samples along each side of a pixel, for smooth borders of the coloured area.
constexpr int kSamples = 2;
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

  /// The (u, v) of a place; nothing when it lies outside.
  [[nodiscard]] std::optional<Pixel> place(Pixel p) const {
    if (!parallelogram_) return place_by_steps(p);
    const Pixel r{p.x - a_.x, p.y - a_.y};
    return inside({r.x * to_u_.x + r.y * to_u_.y, r.x * to_v_.x + r.y * to_v_.y});
  }

 private:
  static constexpr int kSteps = 5;

  static std::optional<Pixel> inside(Pixel at) {
    const auto in_unit = [](double t) { return t >= -kSlack && t <= 1.0 + kSlack; };
    if (!in_unit(at.x) || !in_unit(at.y)) return std::nullopt;
    return Pixel{std::clamp(at.x, 0.0, 1.0), std::clamp(at.y, 0.0, 1.0)};
  }

  /// Newton's method.
  [[nodiscard]] std::optional<Pixel> place_by_steps(Pixel p) const {
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
    return inside({u, v});
  }

  Pixel a_;
  Pixel u_;
  Pixel v_;
  Pixel twist_;
  bool parallelogram_ = false;  ///< the inverse is a matrix then
  Pixel to_u_;
  Pixel to_v_;
};

/// Values on a raster finer than the picture; kNothing where there are none.
class FineField {
 public:
  FineField(int width, int height)
      : width_(kSamples * width),
        height_(kSamples * height),
        values_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kNothing) {}

  [[nodiscard]] float at(int x, int y) const { return values_[index(x, y)]; }

  /// Corners in pixels of the picture.
  void fill(std::array<Pixel, 4> corners, const std::array<double, 4>& values) {
    for (Pixel& p : corners) p = {kSamples * p.x, kSamples * p.y};
    const auto [left, right] = std::ranges::minmax(corners, {}, &Pixel::x);
    const auto [top, bottom] = std::ranges::minmax(corners, {}, &Pixel::y);
    const BilinearQuad quad(corners);
    for (int y = first(top.y); y < std::min(height_, first(bottom.y) + 1); ++y) {
      for (int x = first(left.x); x < std::min(width_, first(right.x) + 1); ++x) {
        const auto place = quad.place({x + 0.5, y + 0.5});
        if (!place) continue;
        const double lower = values[0] + place->x * (values[1] - values[0]);
        const double upper = values[3] + place->x * (values[2] - values[3]);
        values_[index(x, y)] = static_cast<float>(lower + place->y * (upper - lower));
      }
    }
  }

 private:
  static int first(double v) { return std::max(0, static_cast<int>(std::ceil(v - 0.5 - kSlack))); }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  std::vector<float> values_;
};

/// Gives how much of the pixel is painted.
double paint_pixel(Raster& raster, int x, int y, const FineField& field, const MapScale& scale, double within) {
  int covered = 0;
  double sum = 0.0;
  for (int s = 0; s < kSamples * kSamples; ++s) {
    const float value = field.at(kSamples * x + s % kSamples, kSamples * y + s / kSamples);
    if (std::isnan(value)) continue;
    ++covered;
    sum += static_cast<double>(value);
  }
  if (covered == 0) return 0.0;
  const double coverage = within * covered / (kSamples * kSamples);
  raster.blend(x, y, map_colour(scale.position(sum / covered)), coverage);
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
  FineField field(layout.width, layout.height);
  for (const auto& quad : mesh.quads) {
    std::array<Pixel, 4> corners{};
    std::array<double, 4> values{};
    for (std::size_t k = 0; k < 4; ++k) {
      corners[k] = layout.pixel(mesh.nodes[quad[k]]);
      values[k] = static_cast<double>(mesh.values[quad[k]]);
    }
    field.fill(corners, values);
  }
  Mask painted(layout.width, layout.height);
  for (int y = 0; y < layout.height; ++y) {
    int x = 0;
    for (const float coverage : within.row(y)) {
      if (coverage > 0.0F) {
        const double here = paint_pixel(raster, x, y, field, scale, static_cast<double>(coverage));
        painted.add(x, y, static_cast<float>(here));
      }
      ++x;
    }
  }
  return painted;
}

}  // namespace clerestory::io
