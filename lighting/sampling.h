// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "mesh/geometry.h"
#include "mesh/hash.h"

namespace clerestory::lighting {

/// Direction numbers m_i·2^(32-i) by the recurrence of a primitive polynomial. Source: Joe, Kuo 2008, new-joe-kuo-6.
constexpr std::array<std::uint32_t, 32> sobol_directions(std::uint32_t degree, std::uint32_t a,
                                                         std::array<std::uint32_t, 3> m) {
  std::array<std::uint32_t, 32> v{};
  for (std::uint32_t i = 0; i < 32; ++i) {
    if (i < degree) {
      v[i] = m[i] << (31U - i);
      continue;
    }
    v[i] = v[i - degree] ^ (v[i - degree] >> degree);
    for (std::uint32_t k = 1; k < degree; ++k) v[i] ^= ((a >> (degree - 1 - k)) & 1U) * v[i - k];
  }
  return v;
}

inline constexpr std::array<std::array<std::uint32_t, 32>, 3> kSobolDirections{
    sobol_directions(1, 0, {1, 0, 0}), sobol_directions(2, 1, {1, 3, 0}), sobol_directions(3, 1, {1, 3, 1})};

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16U) | (x >> 16U);
  x = ((x & 0x00FF00FFU) << 8U) | ((x & 0xFF00FF00U) >> 8U);
  x = ((x & 0x0F0F0F0FU) << 4U) | ((x & 0xF0F0F0F0U) >> 4U);
  x = ((x & 0x33333333U) << 2U) | ((x & 0xCCCCCCCCU) >> 2U);
  return ((x & 0x55555555U) << 1U) | ((x & 0xAAAAAAAAU) >> 1U);
}

/// What each value of each byte of an index brings to a coordinate: four look-ups in place of a loop over bits. Scrambling works on bits from
/// the other end, so index and coordinate are both the reversed ones.
using SobolBytes = std::array<std::array<std::uint32_t, 256>, 4>;
constexpr SobolBytes sobol_bytes(const std::array<std::uint32_t, 32>& directions) {
  SobolBytes table{};
  for (std::size_t byte = 0; byte < 4; ++byte) {
    for (std::uint32_t value = 0; value < 256; ++value) {
      for (std::size_t bit = 0; bit < 8; ++bit) {
        if (((value >> bit) & 1U) != 0) table[byte][value] ^= reverse_bits(directions[31 - (8 * byte + bit)]);
      }
    }
  }
  return table;
}

inline constexpr std::array<SobolBytes, 3> kSobolBytes{
    sobol_bytes(kSobolDirections[0]), sobol_bytes(kSobolDirections[1]), sobol_bytes(kSobolDirections[2])};

/// Points of Sobol's sequence in up to four dimensions, each dimension scrambled on its own by a hash [Owen 1995; Laine, Karras
/// 2011]: any 2^k consecutive aligned points are stratified, and sequences of different seeds are independent.
class SobolPoints {
 public:
  explicit SobolPoints(std::uint64_t seed) {
    for (std::size_t d = 0; d < seeds_.size(); ++d) seeds_[d] = static_cast<std::uint32_t>(mesh::hash(seed, d));
    order_ = static_cast<std::uint32_t>(mesh::hash(seed, 77));
  }

  /// Coordinate `dimension` [0 … 3] of point `index`, in [0, 1).
  [[nodiscard]] double at(std::uint32_t index, std::size_t dimension) const {
    return coordinate(shuffled(index), dimension);
  }

  /// The first coordinates of point `index` [count, 1 … 4], in less time than one by one.
  template <std::size_t count>
  [[nodiscard]] std::array<double, count> point(std::uint32_t index) const {
    const std::uint32_t place = shuffled(index);
    std::array<double, count> result{};
    for (std::size_t d = 0; d < count; ++d) result[d] = coordinate(place, d);
    return result;
  }

 private:
  /// Owen's nested uniform scrambling of reversed bits. Constants: Burley, Practical Hash-based Owen Scrambling, JCGT 2020.
  static constexpr std::uint32_t scramble(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3D20ADEAU;
    x += seed;
    x *= (seed >> 16U) | 1U;
    x ^= x * 0x05526C56U;
    x ^= x * 0x53A22864U;
    return x;
  }

  /// Coordinate of a reversed place in the sequence, reversed.
  static constexpr std::uint32_t sobol(std::uint32_t place, std::size_t dimension) {
    if (dimension == 0) return reverse_bits(place);
    const SobolBytes& table = kSobolBytes[dimension - 1];
    return table[0][place & 255U] ^ table[1][(place >> 8U) & 255U] ^ table[2][(place >> 16U) & 255U] ^
           table[3][place >> 24U];
  }

  /// The place of a point in the sequence, reversed.
  [[nodiscard]] std::uint32_t shuffled(std::uint32_t index) const { return scramble(reverse_bits(index), order_); }

  [[nodiscard]] double coordinate(std::uint32_t place, std::size_t dimension) const {
    return reverse_bits(scramble(sobol(place, dimension), seeds_[dimension])) * 0x1p-32;
  }

  std::array<std::uint32_t, 4> seeds_{};
  std::uint32_t order_ = 0;
};

/// A direction of the hemisphere about frame.w, its density cos θ / π, from a point of the unit square.
/// Source: Shirley, Chiu, A Low Distortion Map Between Disk and Square, 1997.
inline mesh::Vector cosine_direction(const mesh::Frame& frame, double a, double b) {
  const double x = 2.0 * a - 1.0;
  const double y = 2.0 * b - 1.0;
  double r = 0.0;
  double phi = 0.0;
  if (std::abs(x) > std::abs(y)) {
    r = x;
    phi = 0.25 * std::numbers::pi * (y / x);
  } else if (y != 0.0) {
    r = y;
    phi = 0.5 * std::numbers::pi - 0.25 * std::numbers::pi * (x / y);
  }
  const double u = r * std::cos(phi);
  const double v = r * std::sin(phi);
  const double w = std::sqrt(std::max(0.0, 1.0 - r * r));
  return u * frame.u + v * frame.v + w * frame.w;
}

}  // namespace clerestory::lighting
