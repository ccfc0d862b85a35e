// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/web_sampler.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace clerestory::lighting {

using mesh::Vector;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

WebSampler::WebSampler(const PhotometricWeb& web) : web_(web), flux_before_{0.0} {
  const IntensityGrid& grid = web.grid();
  const std::size_t polar = grid.polar_deg.size();
  const std::size_t planes = grid.azimuth_deg.size();
  const std::size_t gaps = grid.closed ? planes : planes - 1;
  for (std::size_t p = 0; p < gaps; ++p) {
    const std::size_t next = (p + 1) % planes;
    const double width = grid.azimuth_deg[next] - grid.azimuth_deg[p] + (next <= p ? 360.0 : 0.0);
    for (std::size_t k = 0; k + 1 < polar; ++k) {
      const Cell cell{grid.azimuth_deg[p] * kDegree, width * kDegree, std::cos(grid.polar_deg[k + 1] * kDegree),
                      std::cos(grid.polar_deg[k] * kDegree)};
      const auto candela = [&](std::size_t plane) {
        return grid.candela[plane * polar + k] + grid.candela[plane * polar + k + 1];
      };
      const double mean = 0.25 * (candela(p) + candela(next));
      cells_.push_back(cell);
      flux_before_.push_back(flux_before_.back() + mean * cell.width * (cell.high - cell.low));
    }
  }
}

WebSample WebSampler::sample(double a, double b) const {
  const double wanted = a * flux_before_.back();
  const auto found = std::upper_bound(flux_before_.begin() + 1, flux_before_.end() - 1, wanted);
  const auto i = static_cast<std::size_t>(found - flux_before_.begin()) - 1;
  const double flux = flux_before_[i + 1] - flux_before_[i];
  if (flux <= 0.0) return {{0.0, 0.0, -1.0}, 0.0};
  const Cell& cell = cells_[i];
  const double azimuth = cell.azimuth + std::clamp((wanted - flux_before_[i]) / flux, 0.0, 1.0) * cell.width;
  const double along = cell.low + b * (cell.high - cell.low);
  const double across = std::sqrt(std::max(0.0, 1.0 - along * along));
  const PhotometricWeb::Poles& poles = web_.poles();
  const Vector direction =
      along * poles.pole + across * (std::cos(azimuth) * poles.zero + std::sin(azimuth) * poles.quarter);
  const double solid_angle = cell.width * (cell.high - cell.low);
  const double density = flux / (flux_before_.back() * solid_angle);
  return {direction, web_.intensity_cd(direction) / (web_.flux_lm() * density)};
}

}  // namespace clerestory::lighting
