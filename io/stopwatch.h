// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>

#include "lighting/results.h"

namespace clerestory::io {

/// CPU seconds of the process so far, user and system, of all its threads.
double process_cpu_seconds();

/// Largest resident memory of the process so far [MiB].
double peak_memory_mb();

/// Times a phase from its construction on.
class Stopwatch {
 public:
  /// The phase so far, by the name that it shall have.
  [[nodiscard]] lighting::PhaseTime elapsed(std::string name) const;

 private:
  double cpu_s_ = process_cpu_seconds();
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace clerestory::io
