// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/map_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace clerestory::io {

namespace {

constexpr std::size_t kMostIsolines = 9;
constexpr std::size_t kFewestIsolines = 4;
/// Values closer to each other than this share of the largest are all alike.
constexpr double kAlike = 0.02;
/// What lies below this share of the largest value is not worth a line.
constexpr double kSmallestShare = 1e-3;
/// Lines that enclose less than this share of the sensors are not worth drawing either.
constexpr double kSmallestArea = 0.02;

using Series = std::vector<double>;  // mantissas in [1, 10), ascending

/// In the order of preference.
const std::vector<Series>& series_of(MapQuantity quantity) {
  static const std::vector<Series> kDaylightFactor{{1, 2, 3, 5}, {1, 2, 5}, {1, 3}, {1}, {1, 1.5, 2, 3, 5, 7.5}};
  static const std::vector<Series> kIlluminance{{1, 2, 3, 5, 7.5},     {1, 2, 3, 5}, {1, 2, 5}, {1, 3}, {1},
                                                {1, 1.5, 2, 3, 5, 7.5}};
  return quantity == MapQuantity::kDaylightFactor ? kDaylightFactor : kIlluminance;
}

int decade(double value) { return static_cast<int>(std::floor(std::log10(value))); }

/// Powers of ten below one are not exact; dividing by an exact power gives the number that is written "0.3".
double scaled(double mantissa, int power) {
  return power >= 0 ? mantissa * std::pow(10.0, power) : mantissa / std::pow(10.0, -power);
}

/// The members of a series from a decade below `low` to a decade above `high`.
std::vector<double> members(const Series& series, double low, double high) {
  std::vector<double> all;
  for (int power = decade(low) - 1; power <= decade(high) + 1; ++power) {
    for (const double mantissa : series) all.push_back(scaled(mantissa, power));
  }
  return all;
}

std::vector<double> between(const std::vector<double>& all, double low, double high) {
  std::vector<double> inside;
  std::ranges::copy_if(all, std::back_inserter(inside), [&](double v) { return v > low && v < high; });
  return inside;
}

MapScale with_ends(double low_end, std::vector<double> isolines, double high_end) {
  MapScale scale;
  scale.knots.push_back(low_end);
  scale.knots.insert(scale.knots.end(), isolines.begin(), isolines.end());
  scale.knots.push_back(high_end);
  scale.isolines = std::move(isolines);
  return scale;
}

MapScale even_scale(double low, double high, double step) {
  const auto first = static_cast<long>(std::floor(low / step));
  const auto last = std::max(static_cast<long>(std::ceil(high / step)), first + 1);
  std::vector<double> isolines;
  // Through the decimal text, since 3 · 0.1 is not the number that is written "0.3".
  const auto multiple = [step](long n) { return std::stod(fmt::format("{:.9g}", static_cast<double>(n) * step)); };
  for (long n = first + 1; n < last; ++n) isolines.push_back(multiple(n));
  return with_ends(multiple(first), std::move(isolines), multiple(last));
}

MapScale alike_scale(double value) {
  MapScale scale = even_scale(0.9 * value, 1.1 * value, round_step(0.1 * value));
  scale.isolines.clear();
  return scale;
}

/// Familiar steps for lines from `low`, the ends being the members outside the range of the values.
MapScale stepped_scale(const Series& series, double low, double minimum, double maximum) {
  const std::vector<double> all = members(series, low, maximum);
  const auto above = std::ranges::find_if(all, [&](double v) { return v >= maximum; });
  const auto below = std::ranges::find_if(all.rbegin(), all.rend(), [&](double v) { return v <= low; });
  return with_ends(minimum < *below ? 0.0 : *below, between(all, low, maximum), *above);
}

/// Control points in OKLab: lightness from 0.28 to 0.965 in equal steps, hue from 282° over 345° to 108°, chroma 0.165
/// where sRGB holds it [Ottosson, A perceptual color space for image processing, 2020].
constexpr std::array<Rgb, 9> kColours{{{37, 5, 115},
                                       {75, 28, 136},
                                       {122, 45, 143},
                                       {172, 60, 131},
                                       {215, 84, 108},
                                       {245, 118, 81},
                                       {253, 165, 77},
                                       {253, 211, 65},
                                       {255, 251, 106}}};

}  // namespace

double MapScale::position(double value) const {
  if (!(value > knots.front())) return 0.0;
  const auto above = std::ranges::upper_bound(knots, value);
  if (above == knots.end()) return 1.0;
  const double within = (value - *(above - 1)) / (*above - *(above - 1));
  return (static_cast<double>(above - knots.begin() - 1) + within) / static_cast<double>(knots.size() - 1);
}

double MapScale::value(double position) const {
  const double steps = std::clamp(position, 0.0, 1.0) * static_cast<double>(knots.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(steps), knots.size() - 2);
  return std::lerp(knots[below], knots[below + 1], steps - static_cast<double>(below));
}

MapScale choose_scale(std::span<const float> values, MapQuantity quantity) {
  if (values.empty()) return with_ends(0.0, {}, 1.0);
  std::vector<float> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const double minimum = std::max(0.0, static_cast<double>(sorted.front()));
  const double maximum = static_cast<double>(sorted.back());
  if (!(maximum > 0.0)) return with_ends(0.0, {}, 1.0);
  if (maximum - minimum <= kAlike * maximum) return alike_scale(maximum);
  const auto few = static_cast<std::size_t>(kSmallestArea * static_cast<double>(sorted.size()));
  const double low = std::max(static_cast<double>(sorted[few]), kSmallestShare * maximum);
  for (const Series& series : series_of(quantity)) {
    MapScale scale = stepped_scale(series, low, minimum, maximum);
    if (scale.isolines.size() >= kFewestIsolines && scale.isolines.size() <= kMostIsolines) return scale;
  }
  return even_scale(minimum, maximum, round_step((maximum - minimum) / 4.0));
}

Rgb map_colour(double position) {
  const double steps = std::clamp(position, 0.0, 1.0) * static_cast<double>(kColours.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(steps), kColours.size() - 2);
  const double t = steps - static_cast<double>(below);
  const auto mix = [t](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>((1.0 - t) * a + t * b + 0.5);  // rounds: no call for each pixel of a map
  };
  const Rgb a = kColours[below];
  const Rgb b = kColours[below + 1];
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

double round_step(double value) {
  const int power = decade(value);
  for (const double mantissa : {5.0, 2.0}) {
    if (scaled(mantissa, power) <= value) return scaled(mantissa, power);
  }
  return scaled(1.0, power);
}

std::string map_number(double value) {
  if (value == 0.0) return "0";
  if (value < 0.095) return fmt::format("{:.2g}", value);
  if (value < 0.995) return fmt::format("{:.2f}", value);
  return value < 9.95 ? fmt::format("{:.1f}", value) : fmt::format("{:.0f}", value);
}

std::string knot_label(double knot) { return knot >= 1e6 ? fmt::format("{:.3g}", knot) : fmt::format("{:.6g}", knot); }

}  // namespace clerestory::io
