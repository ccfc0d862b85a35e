// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/lamps.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace clerestory::test {

namespace {

lighting::Luminaire lamp(const mesh::Point& at, lighting::IntensityGrid grid) {
  lighting::Luminaire result;
  result.name = "point source";
  result.web = std::make_shared<lighting::PhotometricWeb>(std::move(grid));
  result.at = at;
  return result;
}

}  // namespace

lighting::Luminaire isotropic_lamp(const mesh::Point& at, double intensity_cd) {
  return lamp(at, {.polar_deg = {0.0, 180.0}, .azimuth_deg = {0.0}, .candela = {intensity_cd, intensity_cd}});
}

lighting::Luminaire lambertian_lamp(const mesh::Point& at, const mesh::Vector& aim, double intensity_cd) {
  constexpr int kSteps = 900;
  lighting::IntensityGrid grid{.polar_deg = {}, .azimuth_deg = {0.0}, .candela = {}};
  for (int k = 0; k <= kSteps; ++k) {
    grid.polar_deg.push_back(90.0 * k / kSteps);
    grid.candela.push_back(k == kSteps ? 0.0 : intensity_cd * std::cos(0.5 * std::numbers::pi * k / kSteps));
  }
  lighting::Luminaire result = lamp(at, std::move(grid));
  result.axes = lighting::luminaire_axes(aim, 0.0);
  return result;
}

}  // namespace clerestory::test
