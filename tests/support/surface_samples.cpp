// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/surface_samples.h"

#include <algorithm>

namespace clerestory::support {

using mesh::Point;

namespace {

constexpr std::size_t kSquares = 64;
/// Places on an edge belong to both cells: share of a cell's width.
constexpr double kOnEdge = 1e-9;

double doubled_area(const Point& a, const Point& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

}  // namespace

SurfaceSamples::SurfaceSamples(const lighting::SurfaceResult& surfaces, const std::string& material)
    : surfaces_(surfaces), squares_(kSquares * kSquares) {
  for (std::size_t i = 0; i < surfaces.cells.size(); ++i) {
    if (surfaces.side[i] != 0) continue;
    if (surfaces.material_names.at(static_cast<std::size_t>(surfaces.material[i])) != material) continue;
    cells_.push_back(i);
    for (const std::uint32_t p : surfaces.cells[i]) box_.add(surfaces.points[p]);
  }
  for (const std::size_t i : cells_) {
    mesh::Box box;
    for (const std::uint32_t p : surfaces.cells[i]) box.add(surfaces.points[p]);
    const auto low = square_of(box.low.x, box.low.y);
    const auto high = square_of(box.high.x, box.high.y);
    for (std::size_t y = low[1]; y <= high[1]; ++y)
      for (std::size_t x = low[0]; x <= high[0]; ++x) squares_[y * kSquares + x].push_back(i);
  }
}

std::array<std::size_t, 2> SurfaceSamples::square_of(double x, double y) const {
  const auto index = [](double share) {
    return static_cast<std::size_t>(std::clamp(share, 0.0, 0.999999) * static_cast<double>(kSquares));
  };
  return {index((x - box_.low.x) / box_.size().x), index((y - box_.low.y) / box_.size().y)};
}

std::optional<double> SurfaceSamples::at(double x, double y) const {
  const auto [column, row] = square_of(x, y);
  for (const std::size_t i : squares_[row * kSquares + column]) {
    const auto& cell = surfaces_.cells[i];
    std::array<double, 3> weights{};
    double all = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      weights[k] = doubled_area(surfaces_.points[cell[(k + 1) % 3]], surfaces_.points[cell[(k + 2) % 3]], x, y);
      all += weights[k];
    }
    double value = 0.0;
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      inside = inside && weights[k] / all >= -kOnEdge;
      value += weights[k] / all * surfaces_.point_illuminance_lux[cell[k]];
    }
    if (inside) return value;
  }
  return std::nullopt;
}

}  // namespace clerestory::support
