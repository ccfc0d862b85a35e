// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/sky_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clerestory::lighting {

using mesh::Vector;

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Patches of Tregenza's rows below the zenith.
constexpr std::array<std::size_t, 7> kTregenza{30, 30, 24, 24, 18, 12, 6};

}  // namespace

SkyPatches::SkyPatches(std::size_t parts, double north_deg) : north_rad_(north_deg * std::numbers::pi / 180.0) {
  const double height = 0.5 * std::numbers::pi / (static_cast<double>(kTregenza.size() * parts) + 0.5);
  std::size_t first = 0;
  double low = 0.0;
  for (std::size_t r = 0; r < kTregenza.size() * parts; ++r) {
    const double high = std::sin(static_cast<double>(r + 1) * height);
    rows_.push_back({first, kTregenza[r / parts] * parts, low, high});
    first += rows_.back().patches;
    low = high;
  }
  rows_.push_back({first, 1, low, 1.0});
}

const SkyPatches::Row& SkyPatches::row_of(std::size_t patch) const {
  const auto above =
      std::upper_bound(rows_.begin(), rows_.end(), patch, [](std::size_t p, const Row& row) { return p < row.first; });
  return *(above - 1);
}

std::size_t SkyPatches::of(const Vector& direction) const {
  const auto above = std::upper_bound(rows_.begin() + 1, rows_.end(), direction.z,
                                      [](double sine, const Row& row) { return sine < row.low; });
  const Row& row = *(above - 1);
  const auto patches = static_cast<double>(row.patches);
  // Clockwise from north, which is north_rad_ counter-clockwise from +y.
  const double turns = (std::atan2(direction.x, direction.y) + north_rad_) / kTurn + 0.5 / patches;
  const auto k = static_cast<std::size_t>((turns - std::floor(turns)) * patches);
  return row.first + std::min(k, row.patches - 1);
}

double SkyPatches::solid_angle_sr(std::size_t patch) const {
  const Row& row = row_of(patch);
  return kTurn * (row.high - row.low) / static_cast<double>(row.patches);
}

Vector SkyPatches::direction(std::size_t patch, double a, double b) const {
  const Row& row = row_of(patch);
  const double sine = row.low + b * (row.high - row.low);
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  const double along = (static_cast<double>(patch - row.first) + a - 0.5) / static_cast<double>(row.patches);
  const double azimuth = kTurn * along - north_rad_;
  return {cosine * std::sin(azimuth), cosine * std::cos(azimuth), sine};
}

Vector SkyPatches::centre(std::size_t patch) const {
  if (row_of(patch).patches == 1) return {0.0, 0.0, 1.0};
  return direction(patch, 0.5, 0.5);
}

}  // namespace clerestory::lighting
