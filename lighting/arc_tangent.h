// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>

namespace clerestory::lighting {

/// The angle of the point (x, y) from the x axis, as std::atan2 gives it but for some 1e-15 of its value [−π … π]. Form factors take one
/// an edge, and the C library's, which is right to the last bit, was a sixth of whole runs.
inline double arc_tangent(double y, double x) {
  constexpr double kTanEighth = 0.41421356237309505;  // tan(π/8)
  const double up = std::abs(y);
  const double along = std::abs(x);
  // Reduced to |t| ≤ tan(π/8) by the angle of the nearest of 0, π/4 and π/2.
  double above = up;
  double below = along;
  double from = 0.0;
  if (up > kTanEighth * along) {
    const bool steep = kTanEighth * up >= along;
    above = steep ? -along : up - along;
    below = steep ? up : up + along;
    from = steep ? 0.5 * std::numbers::pi : 0.25 * std::numbers::pi;
  }
  const double t = below > 0.0 ? above / below : 0.0;
  // atan(t)/t in z = t²: the polynomial of least relative error on this range, 9.2e-16, by Remez' exchange.
  const double z = t * t;
  const double z2 = z * z;
  const double z4 = z2 * z2;
  const double low =
      (0.999999999999999083 - 0.333333333332253466 * z) + z2 * (0.199999999789978916 - 0.14285712697774961 * z);
  const double high = (0.111110499323590532 - 0.0908954807130201448 * z) +
                      z2 * (0.0767371419240053256 - 0.0650701138712224572 * z) +
                      z4 * (0.0502795332285900488 - 0.0253577471879850183 * z);
  const double angle = from + t * (low + z4 * high);
  return std::copysign(x < 0.0 ? std::numbers::pi - angle : angle, y);
}

}  // namespace clerestory::lighting
