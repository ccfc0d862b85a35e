// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "lighting/luminaire.h"

namespace clerestory::lighting {

/// A mean over a luminous opening, and what it may be wrong by (k = 1).
struct AreaMean {
  double value = 0.0;
  double error = 0.0;
};

/// Beyond so many times its size a luminaire is a point. At five times, a Lambertian disc differs from a point by 1 % [CIE 121-1996].
inline constexpr double kFarInSizes = 5.0;

/// How well a mean is to be known, as a share of it: at sensors, and where a line is laid through many places.
inline constexpr double kFineMean = 1e-3;
inline constexpr double kRoughMean = 2e-2;

/// The mean of a function of places over the luminous opening of a luminaire: three Gauss points an extent, in parts that are halved along
/// their longest extent until two points an extent tell the same and no edge of a
/// shadow runs through. The points are the same in every run.
template <class Function>
class LuminousAreaMean {
 public:
  /// @param tolerance  share of the mean
  LuminousAreaMean(const Luminaire& luminaire, const Function& function, double tolerance)
      : luminaire_(luminaire), function_(function), tolerance_(tolerance) {}

  [[nodiscard]] AreaMean mean() const {
    AreaMean result;
    add({{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}, 0.0, tolerance_ < kRoughMean ? kHalvings : kFewHalvings, result);
    result.error = std::sqrt(result.error);
    return result;
  }

 private:
  static constexpr int kHalvings = 6;
  static constexpr int kFewHalvings = 1;  ///< where a rough mean will do
  static constexpr double kEdgeError =
      1.0 / 3.0;  ///< of what a part gives that an edge runs through: three points an extent tell where

  struct Part {
    std::array<double, 3> low;
    std::array<double, 3> high;
    [[nodiscard]] double size(std::size_t k) const { return high[k] - low[k]; }
    [[nodiscard]] double share() const { return size(0) * size(1) * size(2); }
  };
  /// Whether something of a part is seen, and all of it.
  struct Seen {
    bool some = false;
    bool all = true;
  };
  struct GaussPoint {
    double at = 0.5;
    double weight = 1.0;
  };

  /// On [0, 1]; an extent of zero has one point.
  [[nodiscard]] std::span<const GaussPoint> points(std::size_t k, std::size_t count) const {
    static constexpr std::array<GaussPoint, 1> kOne{{{0.5, 1.0}}};
    static constexpr std::array<GaussPoint, 2> kTwo{{{0.21132486540518713, 0.5}, {0.78867513459481287, 0.5}}};
    static constexpr std::array<GaussPoint, 3> kThree{
        {{0.11270166537925830, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.88729833462074170, 5.0 / 18.0}}};
    if (extent(k) <= 0.0) return kOne;
    return count == 2 ? std::span<const GaussPoint>(kTwo) : std::span<const GaussPoint>(kThree);
  }

  [[nodiscard]] double extent(std::size_t k) const {
    const LuminousOpening& o = luminaire_.opening;
    return k == 0 ? o.x_m : k == 1 ? o.y_m : o.z_m;
  }

  /// The mean over a part times its share of all.
  [[nodiscard]] double gauss(const Part& part, std::size_t count, Seen& seen) const {
    double sum = 0.0;
    for (const GaussPoint& x : points(0, count)) {
      for (const GaussPoint& y : points(1, count)) {
        for (const GaussPoint& z : points(2, count)) {
          const mesh::Vector own = luminaire_.opening.place(
              part.low[0] + x.at * part.size(0), part.low[1] + y.at * part.size(1), part.low[2] + z.at * part.size(2));
          const double value = function_(luminaire_.place(own));
          seen.some = seen.some || value > 0.0;
          seen.all = seen.all && value > 0.0;
          sum += x.weight * y.weight * z.weight * value;
        }
      }
    }
    return sum * part.share();
  }

  /// @param tolerance  0 for the whole
  void add(const Part& part, double tolerance, int left, AreaMean& result) const {
    Seen seen;
    const double value = gauss(part, 3, seen);
    const double change = std::abs(value - gauss(part, 2, seen));
    const bool has_edge = seen.some && !seen.all;
    if (tolerance <= 0.0) tolerance = tolerance_ * std::abs(value);
    if ((change <= tolerance && !has_edge) || left == 0) {
      result.value += value;
      const double error = has_edge ? std::max(change, kEdgeError * std::abs(value)) : change;
      result.error += error * error;
      return;
    }
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (extent(k) * part.size(k) > extent(longest) * part.size(longest)) longest = k;
    }
    Part half = part;
    half.high[longest] = 0.5 * (part.low[longest] + part.high[longest]);
    add(half, 0.5 * tolerance, left - 1, result);
    half.low[longest] = half.high[longest];
    half.high[longest] = part.high[longest];
    add(half, 0.5 * tolerance, left - 1, result);
  }

  const Luminaire& luminaire_;
  const Function& function_;
  double tolerance_;
};

/// The mean over the luminous opening, as a point from afar sees it: of its centre beyond kFarInSizes.
/// @param tolerance  share of the mean: what two points an extent and three may differ by
template <class Function>
AreaMean mean_over_opening(const Luminaire& luminaire, const mesh::Point& seen_from, const Function& function,
                           double tolerance) {
  const double far = kFarInSizes * luminaire.opening.size_m();
  if (norm(luminaire.at - seen_from) >= far) return {function(luminaire.at), 0.0};
  return LuminousAreaMean<Function>(luminaire, function, tolerance).mean();
}

}  // namespace clerestory::lighting
