// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mesh/error.h"
#include "tools/interruption.h"

namespace clerestory::tools {

namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds kQuietStart{2.0};    // shorter runs need no progress
constexpr Seconds kBetweenLines{0.2};  // faster than that nobody reads

std::string duration_text(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 5400.0) return fmt::format("{:.0f} min", std::ceil(seconds / 60.0));
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

}  // namespace

TerminalProgress::TerminalProgress(bool visible, OnInterruption on_interruption)
    : visible_(visible), on_interruption_(on_interruption) {}

void TerminalProgress::phase(std::string_view name) {
  phase_ = name;
  phase_start_ = Clock::now();
  advance(0.0);
}

void TerminalProgress::advance(double fraction) {
  if (on_interruption_ == OnInterruption::kEnd && interrupted()) throw Interrupted();
  const auto now = Clock::now();
  if (!visible_ || now - start_ < kQuietStart || now - last_shown_ < kBetweenLines) return;
  const Seconds elapsed = now - phase_start_;
  std::fputs(fmt::format("\r{}\033[K", progress_line(phase_, fraction, elapsed.count())).c_str(), stderr);
  std::fflush(stderr);
  last_shown_ = now;
  shown_ = true;
}

bool TerminalProgress::should_finish(double) const {
  return on_interruption_ == OnInterruption::kFinish && interrupted();
}

void TerminalProgress::clear() {
  if (!shown_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

bool stderr_is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

std::string progress_line(std::string_view phase, double fraction, double elapsed_s) {
  const double done = std::clamp(fraction, 0.0, 1.0);
  std::string line = fmt::format("{} {:3.0f} %", phase, std::floor(100.0 * done));
  constexpr double kLeastMeasure = 1.0;  // seconds
  if (done > 0.0 && elapsed_s >= kLeastMeasure) line += ", " + duration_text(elapsed_s * (1.0 - done) / done) + " left";
  return line;
}

}  // namespace clerestory::tools
