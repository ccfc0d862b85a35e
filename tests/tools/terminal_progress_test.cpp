// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal_progress.h"

#include <gtest/gtest.h>

namespace clerestory::tools {
namespace {

TEST(TerminalProgress, SaysPhaseShareAndTimeLeft) {
  EXPECT_EQ(progress_line("gathering", 0.25, 4.0), "gathering  25 %, 12 s left");
  EXPECT_EQ(progress_line("linking", 0.01, 10.0), "linking   1 %, 17 min left");
  EXPECT_EQ(progress_line("linking", 0.001, 10.0), "linking   0 %, 2.8 h left");
}

TEST(TerminalProgress, GuessesNoTimeFromTooLittle) {
  EXPECT_EQ(progress_line("gathering", 0.5, 0.5), "gathering  50 %");
  EXPECT_EQ(progress_line("gathering", 0.0, 30.0), "gathering   0 %");
}

TEST(TerminalProgress, KeepsSharesWithinBounds) {
  EXPECT_EQ(progress_line("gathering", 1.2, 0.0), "gathering 100 %");
  EXPECT_EQ(progress_line("gathering", -0.1, 0.0), "gathering   0 %");
}

TEST(TerminalProgress, PrintsNothingDuringTheFirstSeconds) {
  testing::internal::CaptureStderr();
  {
    TerminalProgress progress(true);
    progress.phase("linking");
    progress.advance(0.5);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace clerestory::tools
