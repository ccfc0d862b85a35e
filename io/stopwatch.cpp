// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/stopwatch.h"

#include <sys/resource.h>

#include <utility>

namespace clerestory::io {

namespace {

rusage usage() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

double process_cpu_seconds() {
  const rusage used = usage();
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

double peak_memory_mb() { return static_cast<double>(usage().ru_maxrss) / 1024.0; }

lighting::PhaseTime Stopwatch::elapsed(std::string name) const {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_;
  return {std::move(name), process_cpu_seconds() - cpu_s_, wall.count()};
}

}  // namespace clerestory::io
