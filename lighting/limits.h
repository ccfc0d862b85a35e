// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

namespace clerestory::lighting {

/// What a run may take beside its accuracy. Runs that meet a limit are not the same bits each time.
struct Limits {
  using Clock = std::chrono::steady_clock;

  Clock::time_point start = Clock::now();  ///< from when on time counts
  double time_s = std::numeric_limits<double>::infinity();
  /// Resident memory [bytes].
  std::uint64_t memory_bytes = std::numeric_limits<std::uint64_t>::max();
  /// Whether the user has named the limit of memory; else it is the machine's.
  bool memory_asked = false;
};

}  // namespace clerestory::lighting
