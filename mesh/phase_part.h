// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "mesh/progress.h"

namespace clerestory {

/// A stretch of the current phase of a long computation, told as if it were all of it. It lives no longer than what it tells.
class PhasePart final : public Progress {
 public:
  /// @param begin, end  the stretch, as shares of the phase [0 … 1]
  PhasePart(Progress& whole, double begin, double end) : whole_(whole), begin_(begin), end_(end) {}

  void phase(std::string_view) override {}
  void advance(double fraction) override { whole_.advance(of_whole(fraction)); }
  [[nodiscard]] bool should_finish(double until = 1.0) const override { return whole_.should_finish(of_whole(until)); }

  /// Tells of step `done` of `count` every so many steps, so that telling costs nothing beside them.
  void advance(std::size_t done, std::size_t count) {
    constexpr std::size_t kBetween = 256;
    if (done % kBetween == 0) advance(static_cast<double>(done) / static_cast<double>(count));
  }

 private:
  [[nodiscard]] double of_whole(double fraction) const { return begin_ + fraction * (end_ - begin_); }

  Progress& whole_;
  double begin_;
  double end_;
};

}  // namespace clerestory
