// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/grid_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/error.h"

namespace clerestory::lighting {

namespace {

using mesh::Point;

/// Cells of one surface; more are a slip in the spacing.
constexpr double kMostCells = 4e6;
/// Sensors this close to the limit of the margin still belong [m]; below any rounding that matters.
constexpr double kRounding = 1e-6;

/// Equal cells along one axis.
struct Axis {
  double start = 0.0;
  double step = 0.0;
  std::size_t count = 0;

  [[nodiscard]] double centre(std::size_t i) const { return start + (static_cast<double>(i) + 0.5) * step; }
};

Axis divide(double low, double high, double margin, double spacing) {
  const double length = high - low - 2.0 * margin;
  if (length <= 0.0) return {};
  const double count = std::max(1.0, std::round(length / spacing));
  return {low + margin, length / count, static_cast<std::size_t>(std::min(count, kMostCells))};
}

double spacing_for(const GridRequest& request, const GridSurface& surface) {
  if (request.en12464_spacing) return en12464_spacing_m(surface.box.size().x, surface.box.size().y);
  return request.spacing_m;
}

void add_cell(const GridSurface& surface, const Axis& x, const Axis& y, std::size_t i, std::size_t j, double height_m,
              Sensors& sensors) {
  const auto at = [&](double px, double py) {
    return surface.to_local({px, py, surface.elevation(px, py) + height_m});
  };
  const double cx = x.centre(i);
  const double cy = y.centre(j);
  const double hx = 0.5 * x.step;
  const double hy = 0.5 * y.step;
  sensors.positions.push_back(at(cx, cy));
  sensors.normals.push_back(surface.frame.w);
  sensors.cells.push_back({at(cx - hx, cy - hy), at(cx + hx, cy - hy), at(cx + hx, cy + hy), at(cx - hx, cy + hy)});
}

void add_outlines(const GridRequest& request, const GridSurface& surface, Sensors& sensors) {
  for (auto loop : surface.loops) {
    for (Point& p : loop) p = surface.to_local({p.x, p.y, p.z + request.height_m});
    sensors.outlines.push_back(std::move(loop));
  }
}

}  // namespace

double en12464_spacing_m(double side_a_m, double side_b_m) {
  const auto [shorter, longer] = std::minmax(side_a_m, side_b_m);
  const double d = longer >= 2.0 * shorter ? shorter : longer;
  return std::min(10.0, 0.2 * std::pow(5.0, std::log10(d)));
}

double margin_m(const GridRequest& request, double smaller_width_m) {
  return request.margin_m.value_or(std::min(0.5, 0.15 * smaller_width_m));
}

void lay_out(const GridRequest& request, const GridSurface& surface, Sensors& sensors) {
  const double margin = margin_m(request, surface.smaller_width_m());
  const double spacing = spacing_for(request, surface);
  const Axis x = divide(surface.box.low.x, surface.box.high.x, margin, spacing);
  const Axis y = divide(surface.box.low.y, surface.box.high.y, margin, spacing);
  if (static_cast<double>(x.count) * static_cast<double>(y.count) > kMostCells) {
    throw InputError(
        "", 0,
        fmt::format("grid '{}': a spacing of {:g} m gives more than {:g} cells on a surface of {:.4g} x {:.4g} m",
                    request.name, spacing, kMostCells, surface.box.size().x, surface.box.size().y),
        "choose a larger spacing");
  }
  for (std::size_t j = 0; j < y.count; ++j) {
    for (std::size_t i = 0; i < x.count; ++i) {
      const double cx = x.centre(i);
      const double cy = y.centre(j);
      if (!surface.contains(cx, cy) || surface.distance_to_outline(cx, cy) < margin - kRounding) continue;
      add_cell(surface, x, y, i, j, request.height_m, sensors);
    }
  }
  add_outlines(request, surface, sensors);
}

void lay_out_middle(const GridRequest& request, const GridSurface& surface, Sensors& sensors) {
  constexpr std::size_t kTries = 24;  // along each side
  const mesh::Vector size = surface.box.size();
  Point best = surface.box.centre();
  double widest = 0.0;
  for (std::size_t k = 0; k < kTries * kTries; ++k) {
    const double x = surface.box.low.x + (static_cast<double>(k % kTries) + 0.5) / kTries * size.x;
    const double y = surface.box.low.y + (static_cast<double>(k / kTries) + 0.5) / kTries * size.y;
    const double distance = surface.contains(x, y) ? surface.distance_to_outline(x, y) : 0.0;
    if (distance <= widest) continue;
    widest = distance;
    best = {x, y, 0.0};
  }
  const double half = std::numbers::sqrt2 / 2.0 * widest;  // the square within the circle that touches the outline
  add_cell(surface, {best.x - half, 2.0 * half, 1}, {best.y - half, 2.0 * half, 1}, 0, 0, request.height_m, sensors);
  add_outlines(request, surface, sensors);
}

}  // namespace clerestory::lighting
