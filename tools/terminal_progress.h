// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "mesh/progress.h"

namespace clerestory::tools {

/// What ctrl-C means to a run: it ends at once, or with what it has.
enum class OnInterruption { kEnd, kFinish };

/// Shows phase, percentage and time left in one line of stderr, once a run has taken two seconds; and passes ctrl-C on.
class TerminalProgress final : public Progress {
 public:
  /// @param visible  false: shows nothing
  explicit TerminalProgress(bool visible, OnInterruption on_interruption = OnInterruption::kEnd);
  ~TerminalProgress() override { clear(); }
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  /// Both throw Interrupted after ctrl-C, if it is to end the run.
  void phase(std::string_view name) override;
  void advance(double fraction) override;
  /// After ctrl-C, if it is to finish the run.
  [[nodiscard]] bool should_finish(double until = 1.0) const override;

  /// Removes the line from the terminal.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool visible_;
  OnInterruption on_interruption_;
  bool shown_ = false;
  std::string phase_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point phase_start_ = start_;
  Clock::time_point last_shown_ = start_;
};

/// Whether somebody watches stderr.
bool stderr_is_terminal();

/// The line for a phase: "gathering  45 %, 12 s left". The time left is told once the phase has run for a second.
std::string progress_line(std::string_view phase, double fraction, double elapsed_s);

}  // namespace clerestory::tools
