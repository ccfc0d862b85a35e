// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace clerestory {

/// How a long computation tells of its way, and hears that it should stop. Called from one thread at a time.
class Progress {
 public:
  virtual ~Progress() = default;

  /// A phase begins; its name is shown to the user ("linking", "gathering").
  virtual void phase(std::string_view name) = 0;

  /// The share of the current phase that is done [0 … 1]. Throws Interrupted when the run should stop.
  virtual void advance(double fraction) = 0;

  /// Whether a computation that can end early, with a coarser answer and a larger error, should do so now: the time for the phase up to
  /// this share of it is over, memory runs short, or the user wants what there is. Cheap; called from any thread.
  [[nodiscard]] virtual bool should_finish(double /*until*/ = 1.0) const { return false; }
};

/// A progress that nobody watches.
class NoProgress final : public Progress {
 public:
  void phase(std::string_view) override {}
  void advance(double) override {}
};

}  // namespace clerestory
