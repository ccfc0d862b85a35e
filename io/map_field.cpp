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

/// Where a place lies in a convex quadrilateral a, b, c, d, (u, v) in the unit square with a at (0, 0), b at (1, 0);
/// nothing when it lies outside. Newton's method, which is exact after one step on parallelograms.
std::optional<Pixel> bilinear_place(Pixel p, const std::array<Pixel, 4>& q) {
  double u = 0.5;
  double v = 0.5;
  for (int step = 0; step < 5; ++step) {
    const auto along_u = [&](double a, double b, double c, double d) { return (1 - v) * (b - a) + v * (c - d); };
    const auto along_v = [&](double a, double b, double c, double d) { return (1 - u) * (d - a) + u * (c - b); };
    const auto at = [&](double a, double b, double c, double d) {
      return (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * d + u * c);
    };
    const double rx = p.x - at(q[0].x, q[1].x, q[2].x, q[3].x);
    const double ry = p.y - at(q[0].y, q[1].y, q[2].y, q[3].y);
    const double ux = along_u(q[0].x, q[1].x, q[2].x, q[3].x);
    const double uy = along_u(q[0].y, q[1].y, q[2].y, q[3].y);
    const double vx = along_v(q[0].x, q[1].x, q[2].x, q[3].x);
    const double vy = along_v(q[0].y, q[1].y, q[2].y, q[3].y);
    const double determinant = ux * vy - uy * vx;
    if (determinant == 0.0) return std::nullopt;
    const double du = (rx * vy - ry * vx) / determinant;
    const double dv = (ux * ry - uy * rx) / determinant;
    u += du;
    v += dv;
    if (std::abs(du) + std::abs(dv) < kSlack) break;
  }
  const auto in_unit = [](double t) { return t >= -kSlack && t <= 1.0 + kSlack; };
  if (!in_unit(u) || !in_unit(v)) return std::nullopt;
  return Pixel{std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0)};
}

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
    for (int y = first(top.y); y < std::min(height_, first(bottom.y) + 1); ++y) {
      for (int x = first(left.x); x < std::min(width_, first(right.x) + 1); ++x) {
        const auto place = bilinear_place({x + 0.5, y + 0.5}, corners);
        if (!place) continue;
        const double lower = std::lerp(values[0], values[1], place->x);
        const double upper = std::lerp(values[3], values[2], place->x);
        values_[index(x, y)] = static_cast<float>(std::lerp(lower, upper, place->y));
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

void paint_pixel(Raster& raster, int x, int y, const FineField& field, const MapScale& scale, double within) {
  int covered = 0;
  double sum = 0.0;
  for (int s = 0; s < kSamples * kSamples; ++s) {
    const float value = field.at(kSamples * x + s % kSamples, kSamples * y + s / kSamples);
    if (std::isnan(value)) continue;
    ++covered;
    sum += static_cast<double>(value);
  }
  if (covered == 0) return;
  raster.blend(x, y, map_colour(scale.position(sum / covered)), within * covered / (kSamples * kSamples));
}

}  // namespace

Mask field_mask(const MapPlan& plan, const MapLayout& layout) {
  Mask mask(layout.width, layout.height);
  for (const MapOutline& outline : plan.outlines) {
    if (!outline.hole) mask.add_polygon(layout.pixels(outline.loop));
  }
  for (std::size_t i = 0; i < plan.cells.size(); ++i) {
    if (plan.inside[i] == 0) mask.add_polygon(layout.pixels(plan.cells[i]));
  }
  return mask;
}

void paint_field(Raster& raster, const MapMesh& mesh, const MapLayout& layout, const MapScale& scale,
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
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      const auto coverage = static_cast<double>(within.at(x, y));
      if (coverage > 0.0) paint_pixel(raster, x, y, field, scale, coverage);
    }
  }
}

}  // namespace clerestory::io
