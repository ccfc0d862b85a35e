// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/photometry.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace clerestory::lighting {

namespace {

using Symmetry = Photometry::Symmetry;

/// Planes by their azimuth; of two for one azimuth the first stays.
using Planes = std::map<double, std::vector<double>>;

double within_circle(double degrees) {
  const double rest = std::fmod(degrees, 360.0);
  return rest < 0.0 ? rest + 360.0 : rest;
}

Planes stated_planes(const Photometry& p) {
  const std::size_t count = p.vertical_deg.size();
  Planes planes;
  for (std::size_t k = 0; k < p.horizontal_deg.size(); ++k) {
    const auto first = p.candela.begin() + static_cast<std::ptrdiff_t>(k * count);
    planes.emplace(p.horizontal_deg[k], std::vector<double>(first, first + static_cast<std::ptrdiff_t>(count)));
  }
  return planes;
}

/// Adds the mirror image of each plane; `axis` is twice the azimuth of the mirror.
template <class Normalise>
void add_mirrored(Planes& planes, double axis, Normalise normalise) {
  const Planes stated = planes;
  for (const auto& [azimuth, candela] : stated) planes.emplace(normalise(axis - azimuth), candela);
}

IntensityGrid grid_of(const Planes& planes, std::vector<double> polar, bool closed) {
  IntensityGrid grid;
  grid.polar_deg = std::move(polar);
  grid.closed = closed;
  for (const auto& [azimuth, candela] : planes) {
    grid.azimuth_deg.push_back(azimuth);
    grid.candela.insert(grid.candela.end(), candela.begin(), candela.end());
  }
  return grid;
}

PhotometricWeb type_c(const Photometry& p) {
  Planes planes;
  for (auto& [azimuth, candela] : stated_planes(p)) planes.emplace(within_circle(azimuth), candela);
  if (p.symmetry == Symmetry::kMirrorC0 || p.symmetry == Symmetry::kQuadrants) add_mirrored(planes, 0.0, within_circle);
  if (p.symmetry == Symmetry::kMirrorC90 || p.symmetry == Symmetry::kQuadrants)
    add_mirrored(planes, 180.0, within_circle);
  return PhotometricWeb(grid_of(planes, p.vertical_deg, true));
}

/// Types A and B state a half or less of the sphere.
PhotometricWeb type_a_or_b(const Photometry& p) {
  Planes planes = stated_planes(p);
  if (p.symmetry == Symmetry::kMirrorC0) add_mirrored(planes, 0.0, [](double azimuth) { return azimuth; });
  std::vector<double> polar;
  for (const double v : p.vertical_deg) polar.push_back(90.0 + v);
  // Both count horizontal angles clockwise.
  const PhotometricWeb::Poles a{{0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}};
  const PhotometricWeb::Poles b{{-1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, -1.0, 0.0}};
  return {grid_of(planes, std::move(polar), false), p.type == Photometry::Type::kA ? a : b};
}

}  // namespace

double TiltTable::at(double angle_deg) const {
  const auto above = std::lower_bound(angles_deg.begin(), angles_deg.end(), angle_deg);
  if (above == angles_deg.begin()) return multipliers.front();
  if (above == angles_deg.end()) return multipliers.back();
  const auto k = static_cast<std::size_t>(above - angles_deg.begin());
  const double share = (angle_deg - angles_deg[k - 1]) / (angles_deg[k] - angles_deg[k - 1]);
  return (1.0 - share) * multipliers[k - 1] + share * multipliers[k];
}

PhotometricWeb web_of(const Photometry& p) { return p.type == Photometry::Type::kC ? type_c(p) : type_a_or_b(p); }

}  // namespace clerestory::lighting
