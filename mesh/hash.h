// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace clerestory::mesh {

/// Mixes a 64-bit word. Source: Stafford's variant 13 of the MurmurHash3 finaliser, as in SplitMix64.
constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

/// A hash of two words that depends on their order.
constexpr std::uint64_t hash(std::uint64_t a, std::uint64_t b) { return mix(mix(a) + 0x632BE59BD9B4E019ULL * b); }

}  // namespace clerestory::mesh
