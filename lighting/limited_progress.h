// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "lighting/limits.h"
#include "lighting/results.h"
#include "mesh/progress.h"

namespace clerestory::lighting {

/// The progress of a run with limits. Each stage of it has its share of them, so that what comes later still can be done: a solution that
/// stops early must be shown all the same.
class LimitedProgress final : public Progress {
 public:
  enum class Stage { kPreparing, kDirectLight, kLinking, kGathering, kShowing };

  LimitedProgress(Progress& watched, const Limits& limits);

  /// What follows the run needs about so much of the time limit [CPU s]; on a machine that is busy with other work as much more as the run
  /// itself has needed so far. Never more than half of the limit. Serial.
  void leave_time(double cpu_s);

  /// The next stage begins. Serial.
  void enter(Stage stage);

  void phase(std::string_view name) override;
  /// Thrown where showing must end: what has been found can be shown in a simpler way.
  struct ShowingIsOver {};

  /// Where a limit is met, or the user wants what there is: in preparing throws LimitReached, MachineError (the machine's own memory) or
  /// Interrupted; in showing, ShowingIsOver.
  void advance(double fraction) override;
  [[nodiscard]] bool should_finish(double until = 1.0) const override;

  /// The stage could refine no further because there may be no more elements. Serial.
  void out_of_elements();

  /// What has made a stage end early, the first time; elements, where nothing else has.
  [[nodiscard]] std::optional<Stop> stopped() const;
  /// Whether nothing has stopped before the solution was found. One of as many elements as there may be is whole.
  [[nodiscard]] bool converged() const;

 private:
  static constexpr int kNothing = -1;

  /// Notes it, the first time.
  void stop(Stop::By by) const;
  [[nodiscard]] bool is_late(double until) const;
  [[nodiscard]] bool is_full() const;
  [[noreturn]] void give_up() const;

  Progress& watched_;
  Limits limits_;
  Stage stage_ = Stage::kPreparing;
  std::string phase_;
  double begin_s_ = 0.0;          ///< when the stage began
  double left_s_ = 0.0;           ///< of the time limit, for what follows
  std::uint64_t most_bytes_ = 0;  ///< that the stage may hold
  mutable std::atomic<bool> full_ = false;
  mutable std::atomic<std::int64_t> next_look_ns_ = 0;  ///< at the memory
  mutable std::atomic<int> stopped_by_ = kNothing;
  mutable std::atomic<int> stopped_in_ = kNothing;
  std::optional<Stage> out_of_elements_in_;
};

}  // namespace clerestory::lighting
