// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/hash.h"

namespace clerestory::fuzz {

/// The same numbers from the same seed on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}

  /// A number below `end`; 0 where that is 0.
  std::size_t below(std::size_t end) { return end == 0 ? 0 : static_cast<std::size_t>(mesh::mix(state_++) % end); }

 private:
  std::uint64_t state_;
};

/// A seed, damaged in one to four ways: bits flipped, bytes, numbers and words replaced, pieces and lines cut out, repeated, exchanged or
/// taken from another seed, or the end cut off. At least one seed.
std::string mutated(const std::vector<std::string>& seeds, Dice& dice);

}  // namespace clerestory::fuzz
