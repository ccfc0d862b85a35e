// SPDX-License-Identifier: GPL-3.0-or-later
#include "lighting/limited_progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mesh/error.h"

namespace clerestory::lighting {
namespace {

using std::chrono::duration_cast;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;
using Stage = LimitedProgress::Stage;

/// A user who wants what there is, once told to.
class User final : public Progress {
 public:
  void phase(std::string_view name) override { phases.emplace_back(name); }
  void advance(double fraction) override { shares.push_back(fraction); }
  [[nodiscard]] bool should_finish(double) const override { return wants_it; }

  bool wants_it = false;
  std::vector<std::string> phases;
  std::vector<double> shares;
};

/// Limits of a run that began so long ago.
Limits limits_after(double elapsed_s, double time_s) {
  Limits limits;
  limits.time_s = time_s;
  limits.start -= duration_cast<Limits::Clock::duration>(std::chrono::duration<double>(elapsed_s));
  return limits;
}

template <class Call>
std::string complaint(const Call& call) {
  try {
    call();
  } catch (const LimitReached& error) {
    return error.what();
  }
  return "none";
}

TEST(LimitedProgress, WithoutLimitsItPassesAllOnAndStopsNothing) {
  User user;
  LimitedProgress progress(user, {});
  progress.phase("welding");
  progress.advance(0.5);
  for (const Stage stage : {Stage::kDirectLight, Stage::kLinking, Stage::kGathering, Stage::kShowing}) {
    progress.enter(stage);
    progress.advance(1.0);
    EXPECT_FALSE(progress.should_finish());
  }
  EXPECT_THAT(user.phases, testing::ElementsAre("welding"));
  EXPECT_THAT(user.shares, testing::ElementsAre(0.5, 1.0, 1.0, 1.0, 1.0));
  EXPECT_FALSE(progress.stopped());
  EXPECT_TRUE(progress.converged());
}

TEST(LimitedProgress, BeforeThereIsAnythingToShowALimitIsAnError) {
  NoProgress nobody;
  LimitedProgress late(nobody, limits_after(20.0, 10.0));
  late.phase("gaps");
  EXPECT_THAT(complaint([&] { late.advance(0.1); }), HasSubstr("10 s given were over in the phase 'gaps'"));
  LimitedProgress full(nobody, {.memory_bytes = 1 << 20, .memory_asked = true});
  EXPECT_THAT(complaint([&] { full.advance(0.1); }), HasSubstr("1 MB that was given"));
  LimitedProgress machine(nobody, {.memory_bytes = 1 << 20});
  EXPECT_THROW(machine.advance(0.1), MachineError);
  User user;
  user.wants_it = true;
  LimitedProgress stopped(user, {});
  EXPECT_THROW(stopped.advance(0.1), Interrupted);
}

TEST(LimitedProgress, ASolutionMustLeaveTimeToBeShown) {
  NoProgress nobody;
  LimitedProgress progress(nobody, limits_after(80.0, 100.0));
  progress.enter(Stage::kGathering);
  EXPECT_FALSE(progress.should_finish());
  progress.enter(Stage::kLinking);
  EXPECT_TRUE(progress.should_finish());
  ASSERT_TRUE(progress.stopped());
  EXPECT_EQ(progress.stopped()->by, Stop::By::kTime);
  EXPECT_EQ(progress.stopped()->phase, "linking");
  EXPECT_FALSE(progress.converged());
}

TEST(LimitedProgress, ASolutionOfAsManyElementsAsThereMayBeIsWhole) {
  User user;
  LimitedProgress progress(user, {});
  progress.enter(Stage::kDirectLight);
  progress.out_of_elements();
  progress.enter(Stage::kLinking);
  progress.out_of_elements();
  ASSERT_TRUE(progress.stopped());
  EXPECT_EQ(progress.stopped()->by, Stop::By::kElements);
  EXPECT_EQ(progress.stopped()->phase, "direct light");
  EXPECT_TRUE(progress.converged());
  EXPECT_FALSE(progress.should_finish());
  user.wants_it = true;
  EXPECT_TRUE(progress.should_finish());
  EXPECT_EQ(progress.stopped()->by, Stop::By::kUser);  // cut short all the same
  EXPECT_FALSE(progress.converged());
}

TEST(LimitedProgress, EachShareOfAPhaseHasItsTime) {
  NoProgress nobody;
  LimitedProgress progress(nobody, limits_after(50.0, 100.0));
  progress.enter(Stage::kGathering);
  EXPECT_FALSE(progress.should_finish(0.5));
  EXPECT_TRUE(progress.should_finish(0.0));
  EXPECT_TRUE(progress.converged());  // what is gathered from was found
}

TEST(LimitedProgress, TheFirstStopIsTheOneThatIsTold) {
  User user;
  LimitedProgress progress(user, limits_after(50.0, 100.0));
  progress.enter(Stage::kDirectLight);
  user.wants_it = true;
  EXPECT_TRUE(progress.should_finish());
  progress.enter(Stage::kLinking);
  EXPECT_TRUE(progress.should_finish());
  EXPECT_EQ(progress.stopped()->by, Stop::By::kUser);
  EXPECT_EQ(progress.stopped()->phase, "direct light");
}

TEST(LimitedProgress, AStageMayHoldItsShareOfTheMemoryThatIsLeft) {
  NoProgress nobody;
  LimitedProgress progress(nobody, {.memory_bytes = 1});  // less than any process holds
  progress.enter(Stage::kLinking);
  EXPECT_TRUE(progress.should_finish());
  EXPECT_EQ(progress.stopped()->by, Stop::By::kMemory);
  progress.enter(Stage::kShowing);
  progress.phase("shadows");
  EXPECT_TRUE(progress.should_finish(0.0));
}

TEST(LimitedProgress, TimeForWhatFollowsIsLeftButNeverMoreThanHalf) {
  NoProgress nobody;
  LimitedProgress progress(nobody, limits_after(40.0, 100.0));
  progress.enter(Stage::kGathering);
  progress.leave_time(1e9);
  EXPECT_FALSE(progress.should_finish()) << "45 s are over at 45 s";
  LimitedProgress later(nobody, limits_after(50.0, 100.0));
  later.enter(Stage::kGathering);
  EXPECT_FALSE(later.should_finish()) << "without anything to follow";
  later.leave_time(1e9);
  EXPECT_TRUE(later.should_finish());
}

TEST(LimitedProgress, PreparingMayUseAllOfTheTime) {
  NoProgress nobody;
  LimitedProgress progress(nobody, limits_after(90.0, 100.0));
  progress.leave_time(1e9);
  EXPECT_FALSE(progress.should_finish());
}

TEST(LimitedProgress, ShowingThatIsLateEndsWithoutAnError) {
  NoProgress nobody;
  LimitedProgress progress(nobody, limits_after(99.0, 100.0));
  progress.enter(Stage::kShowing);
  EXPECT_THROW(progress.advance(0.5), LimitedProgress::ShowingIsOver);
}

}  // namespace
}  // namespace clerestory::lighting
