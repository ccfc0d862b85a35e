// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/limited_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "mesh/error.h"
#include "mesh/memory.h"

namespace clerestory::lighting {

namespace {

/// What a stage may use.
struct Share {
  const char* name;
  double time;    ///< of the limit, when the stage must be at its end
  double memory;  ///< of what was left when it began: for lists that grow by doubling, and what is made of them
};

/// In the order of LimitedProgress::Stage. A fortieth of the time is left for writing.
constexpr std::array<Share, 5> kShares{{{"preparing", 1.0, 0.9},
                                        {"direct light", 0.4, 0.5},
                                        {"linking", 0.65, 0.4},
                                        {"gathering", 0.9, 0.9},
                                        {"showing surfaces", 0.975, 0.9}}};

/// Between two looks at the memory [ns]: a look costs some microseconds.
constexpr std::int64_t kBetweenLooksNs = 10'000'000;

const Share& share_of(LimitedProgress::Stage stage) { return kShares[static_cast<std::size_t>(stage)]; }

double seconds_since(Limits::Clock::time_point start) {
  return std::chrono::duration<double>(Limits::Clock::now() - start).count();
}

}  // namespace

LimitedProgress::LimitedProgress(Progress& watched, const Limits& limits) : watched_(watched), limits_(limits) {
  enter(Stage::kPreparing);
}

void LimitedProgress::leave_time(double cpu_s) {
  if (std::isinf(limits_.time_s)) return;
  const double used_s = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  const double slowness = used_s > 0.0 ? std::max(1.0, seconds_since(limits_.start) / used_s) : 1.0;
  left_s_ = std::min(slowness * cpu_s, 0.5 * limits_.time_s);
}

void LimitedProgress::enter(Stage stage) {
  stage_ = stage;
  begin_s_ = seconds_since(limits_.start);
  const std::uint64_t now = resident_bytes();
  const std::uint64_t left = limits_.memory_bytes > now ? limits_.memory_bytes - now : 0;
  most_bytes_ = now + static_cast<std::uint64_t>(share_of(stage).memory * static_cast<double>(left));
  full_ = false;
  next_look_ns_ = 0;
}

void LimitedProgress::phase(std::string_view name) {
  phase_ = name;
  watched_.phase(name);
}

void LimitedProgress::advance(double fraction) {
  watched_.advance(fraction);
  if (stage_ == Stage::kPreparing && should_finish()) give_up();
  if (stage_ == Stage::kShowing && should_finish()) throw ShowingIsOver();
}

bool LimitedProgress::should_finish(double until) const {
  if (watched_.should_finish(until)) {
    stop(Stop::By::kUser);
  } else if (is_full()) {
    stop(Stop::By::kMemory);
  } else if (is_late(until)) {
    stop(Stop::By::kTime);
  } else {
    return false;
  }
  return true;
}

void LimitedProgress::out_of_elements() {
  if (!out_of_elements_in_) out_of_elements_in_ = stage_;
}

std::optional<Stop> LimitedProgress::stopped() const {
  if (stopped_by_ != kNothing)
    return Stop{static_cast<Stop::By>(stopped_by_.load()), share_of(static_cast<Stage>(stopped_in_.load())).name};
  if (out_of_elements_in_) return Stop{Stop::By::kElements, share_of(*out_of_elements_in_).name};
  return std::nullopt;
}

bool LimitedProgress::converged() const {
  return stopped_by_ == kNothing || static_cast<Stage>(stopped_in_.load()) > Stage::kLinking;
}

void LimitedProgress::stop(Stop::By by) const {
  int nothing = kNothing;
  if (stopped_by_.compare_exchange_strong(nothing, static_cast<int>(by))) stopped_in_ = static_cast<int>(stage_);
}

bool LimitedProgress::is_late(double until) const {
  if (std::isinf(limits_.time_s)) return false;
  // Before there is anything to show, all of the time may be used: what follows is late then, but there.
  const double given_s = stage_ == Stage::kPreparing ? limits_.time_s : limits_.time_s - left_s_;
  const double end_s = share_of(stage_).time * given_s;
  return seconds_since(limits_.start) >= begin_s_ + until * std::max(0.0, end_s - begin_s_);
}

bool LimitedProgress::is_full() const {
  if (full_.load(std::memory_order_relaxed)) return true;
  const std::int64_t now = Limits::Clock::now().time_since_epoch().count();
  std::int64_t due = next_look_ns_.load(std::memory_order_relaxed);
  if (now < due || !next_look_ns_.compare_exchange_strong(due, now + kBetweenLooksNs)) return false;
  if (resident_bytes() < most_bytes_) return false;
  full_ = true;
  return true;
}

void LimitedProgress::give_up() const {
  switch (static_cast<Stop::By>(stopped_by_.load())) {
    case Stop::By::kUser:
      throw Interrupted();
    case Stop::By::kTime:
      throw LimitReached(
          fmt::format("the {:.6g} s given were over in the phase '{}', before there was anything to show; "
                      "give --max-time more",
                      limits_.time_s, phase_));
    case Stop::By::kMemory:
    case Stop::By::kElements:
      break;
  }
  const std::string line = fmt::format(
      "the memory of {:.0f} MB that {} does not suffice for the phase '{}', and there is nothing to show yet",
      static_cast<double>(limits_.memory_bytes) / (1 << 20),
      limits_.memory_asked ? "was given" : "the machine has left", phase_);
  if (limits_.memory_asked) throw LimitReached(line + "; give --max-memory more");
  throw MachineError(line + "; leave parts of the model out, or take a larger machine");
}

}  // namespace clerestory::lighting
