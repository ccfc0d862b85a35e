// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <span>

namespace clerestory::lighting {

/// The mean of independent estimates of one value, and how far it may be off.
struct ReplicateMean {
  double mean = 0.0;
  double variance = 0.0;  ///< of the mean, not of a single estimate

  [[nodiscard]] double standard_error() const { return std::sqrt(variance); }
};

/// From independently scrambled sets of points, whose spread tells the error that no single set can [Owen 1995].
/// @param estimates  at least two
inline ReplicateMean mean_of_replicates(std::span<const double> estimates) {
  const auto count = static_cast<double>(estimates.size());
  ReplicateMean result;
  for (const double e : estimates) result.mean += e / count;
  double square = 0.0;
  for (const double e : estimates) square += (e - result.mean) * (e - result.mean);
  result.variance = square / (count * (count - 1.0));
  return result;
}

}  // namespace clerestory::lighting
