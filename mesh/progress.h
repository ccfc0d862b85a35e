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
};

/// A progress that nobody watches.
class NoProgress final : public Progress {
 public:
  void phase(std::string_view) override {}
  void advance(double) override {}
};

}  // namespace clerestory
