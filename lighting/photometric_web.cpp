// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/photometric_web.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace clerestory::lighting {

using mesh::Vector;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
/// Rounding must not put what is at the edge of the grid beyond it [degrees].
constexpr double kEdge = 1e-9;

/// A place between two grid values.
struct Between {
  std::size_t below = 0;
  std::size_t above = 0;
  double share = 0.0;  ///< of the one above
};

/// Where a value lies in a list that holds it between its ends.
Between find(const std::vector<double>& list, double value) {
  const auto above = std::upper_bound(list.begin(), list.end(), value);
  if (above == list.begin()) return {};
  if (above == list.end()) return {list.size() - 1, list.size() - 1, 0.0};
  const auto k = static_cast<std::size_t>(above - list.begin());
  return {k - 1, k, (value - list[k - 1]) / (list[k] - list[k - 1])};
}

bool beyond(const std::vector<double>& list, double value) {
  return value < list.front() - kEdge || value > list.back() + kEdge;
}

/// Where an azimuth in 0 … 360 lies among planes that go round.
Between find_round(const std::vector<double>& planes, double azimuth) {
  if (planes.size() == 1) return {};
  if (azimuth >= planes.front() && azimuth < planes.back()) return find(planes, azimuth);
  const double gap = planes.front() + 360.0 - planes.back();
  const double past = azimuth >= planes.back() ? azimuth - planes.back() : azimuth + 360.0 - planes.back();
  return {planes.size() - 1, 0, past / gap};
}

/// The flux of one plane by radian of azimuth: the exact integral of what is linear in the polar angle, times its sine.
double plane_integral(const IntensityGrid& grid, std::size_t plane) {
  const std::size_t count = grid.polar_deg.size();
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const double a = grid.polar_deg[k] * kDegree;
    const double b = grid.polar_deg[k + 1] * kDegree;
    const double slope = (std::sin(b) - std::sin(a)) / (b - a);
    sum += grid.candela[plane * count + k] * (std::cos(a) - slope) +
           grid.candela[plane * count + k + 1] * (slope - std::cos(b));
  }
  return sum;
}

/// Half of the angle between a plane's neighbours [radians]: its weight in a sum that is exact for what is linear in between.
double plane_weight(const IntensityGrid& grid, std::size_t plane) {
  const std::vector<double>& planes = grid.azimuth_deg;
  const std::size_t count = planes.size();
  if (grid.closed && count == 1) return 360.0 * kDegree;
  double width = 0.0;
  if (plane > 0) width += planes[plane] - planes[plane - 1];
  if (plane + 1 < count) width += planes[plane + 1] - planes[plane];
  if (grid.closed && (plane == 0 || plane + 1 == count)) width += planes.front() + 360.0 - planes.back();
  return 0.5 * width * kDegree;
}

Vector quarter_turned(const Vector& v) { return {-v.y, v.x, v.z}; }
Vector flipped(const Vector& v) { return {v.x, -v.y, v.z}; }

}  // namespace

PhotometricWeb::PhotometricWeb(IntensityGrid grid, const Poles& poles) : grid_(std::move(grid)), poles_(poles) {
  assert(!grid_.polar_deg.empty() && !grid_.azimuth_deg.empty());
  assert(grid_.candela.size() == grid_.polar_deg.size() * grid_.azimuth_deg.size());
  for (std::size_t plane = 0; plane < grid_.azimuth_deg.size(); ++plane)
    flux_lm_ += plane_weight(grid_, plane) * plane_integral(grid_, plane);
  peak_cd_ = *std::max_element(grid_.candela.begin(), grid_.candela.end());
}

double PhotometricWeb::in_plane(std::size_t plane, double polar_deg) const {
  const Between at = find(grid_.polar_deg, polar_deg);
  const double* candela = &grid_.candela[plane * grid_.polar_deg.size()];
  return (1.0 - at.share) * candela[at.below] + at.share * candela[at.above];
}

double PhotometricWeb::intensity_cd(const Vector& d) const {
  const double along = dot(d, poles_.pole);
  const double x = dot(d, poles_.zero);
  const double y = dot(d, poles_.quarter);
  // By the arc tangent, since the arc cosine is rough near the poles.
  const double polar = std::atan2(std::hypot(x, y), along) / kDegree;
  if (beyond(grid_.polar_deg, polar)) return 0.0;
  double azimuth = std::atan2(y, x) / kDegree;
  if (!grid_.closed && beyond(grid_.azimuth_deg, azimuth)) return 0.0;
  if (grid_.closed && azimuth < 0.0) azimuth += 360.0;
  const Between at = grid_.closed ? find_round(grid_.azimuth_deg, azimuth) : find(grid_.azimuth_deg, azimuth);
  const double below = in_plane(at.below, polar);
  return at.share > 0.0 ? (1.0 - at.share) * below + at.share * in_plane(at.above, polar) : below;
}

double PhotometricWeb::intensity_cd(double c_deg, double gamma_deg) const {
  return intensity_cd(direction_at(c_deg, gamma_deg));
}

PhotometricWeb PhotometricWeb::turned(int quarters) const {
  PhotometricWeb result = *this;
  for (int k = ((quarters % 4) + 4) % 4; k > 0; --k) {
    Poles& p = result.poles_;
    p = {quarter_turned(p.pole), quarter_turned(p.zero), quarter_turned(p.quarter)};
  }
  return result;
}

PhotometricWeb PhotometricWeb::mirrored() const {
  PhotometricWeb result = *this;
  result.poles_ = {flipped(poles_.pole), flipped(poles_.zero), flipped(poles_.quarter)};
  return result;
}

Vector direction_at(double c_deg, double gamma_deg) {
  const double c = c_deg * kDegree;
  const double gamma = gamma_deg * kDegree;
  return {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), -std::cos(gamma)};
}

}  // namespace clerestory::lighting
