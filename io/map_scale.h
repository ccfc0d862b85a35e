// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/raster.h"

namespace clerestory::io {

/// What a map shows.
enum class MapQuantity { kIlluminance, kDaylightFactor };

/// From values to colours. The knots are round values with equal steps of colour between them, so that a dark room can be
/// read as well as a bright window; isolines and the ticks of the legend stand at knots.
struct MapScale {
  std::vector<double> knots;     ///< ascending, at least two [lx or %]
  std::vector<double> isolines;  ///< the knots within the range of the values [lx or %]

  /// Where a value lies on the scale [0 … 1]; clamped.
  [[nodiscard]] double position(double value) const;
  /// The value at a place on the scale [0 … 1].
  [[nodiscard]] double value(double position) const;
};

/// A scale for values of at least 0. Wide ranges take the familiar steps (daylight factors 1, 2, 3, 5, 10 %; illuminances
/// 100, 200, 300, 500, 750, 1000 lx, the steps of EN 12464-1), narrow ones even steps; values that are all alike get no
/// isoline.
MapScale choose_scale(std::span<const float> values, MapQuantity quantity);

/// The colour at a place on the scale [0 … 1]: indigo, purple, red, orange, yellow, ever lighter, so that the order of
/// values can be seen, also in a grey print and with a colour vision deficiency.
Rgb map_colour(double position);

/// The round number (1, 2 or 5 times a power of ten) next to a positive value, not above it.
double round_step(double value);

/// A value as it is printed on the map, with two or three significant digits.
std::string map_number(double value);

/// A knot in as few digits as it needs: "0.5", "750", "15000".
std::string knot_label(double knot);

}  // namespace clerestory::io
