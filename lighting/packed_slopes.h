// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace clerestory::lighting {

/// A number in 16 bits: sign, 5 bits of exponent, 10 of mantissa. Magnitudes from 2^-17 to 2^14 are right to one in 2048; what is smaller
/// is zero, what is larger the largest. Without subnormal numbers, whose treatment depends on the state of the processor.
class Packed {
 public:
  Packed() = default;
  explicit Packed(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value * (1.0F / kUnit));
    const std::uint32_t magnitude = bits & 0x7FFFFFFFU;
    const std::uint32_t rounded = (magnitude + 0xFFFU + ((magnitude >> kDropped) & 1U)) >> kDropped;  // to even
    if (rounded < kSmallest) return;
    bits_ = static_cast<std::uint16_t>(std::min(rounded, kLargest) | (bits >> 16U & kSign));
  }
  /// What was packed before.
  static Packed of_bits(std::uint16_t bits) {
    Packed packed;
    packed.bits_ = bits;
    return packed;
  }

  [[nodiscard]] std::uint16_t bits() const { return bits_; }
  [[nodiscard]] float value() const {
    const std::uint32_t bits{bits_};
    return std::bit_cast<float>((bits & kLargest) << kDropped | (bits & kSign) << 16U) * kUnit;
  }
  bool operator==(const Packed&) const = default;

 private:
  static constexpr float kUnit = 0x1p109F;       ///< takes the least exponent of a float to that of 2^-17
  static constexpr std::uint32_t kDropped = 13;  ///< bits of a float's mantissa
  static constexpr std::uint32_t kSmallest = 0x400;
  static constexpr std::uint32_t kLargest = 0x7FFF;
  static constexpr std::uint32_t kSign = 0x8000;
  std::uint16_t bits_ = 0;
};

/// How the light of a link runs over its receiver and by the place on its source, in terms of its factor [1/m]: see Link.
/// An element of 10 m with a slope too small to be kept differs by 4 in 100,000 from edge to edge.
struct PackedSlopes {
  Packed slope_u;
  Packed slope_v;
  Packed moment_u;
  Packed moment_v;

  bool operator==(const PackedSlopes&) const = default;
};

}  // namespace clerestory::lighting
