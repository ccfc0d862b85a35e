// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/memory.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <vector>

namespace clerestory {
namespace {

constexpr std::uint64_t kMega = 1 << 20;

TEST(Memory, WhatIsHeldIsWhatWasWrittenTo) {
  const std::uint64_t before = resident_bytes();
  const std::vector<char> held(64 * kMega, 'x');
  EXPECT_GT(resident_bytes(), before + 60 * kMega);
  EXPECT_EQ(held.back(), 'x');
}

TEST(Memory, WithinReachIsMoreThanIsHeld) { EXPECT_GT(memory_within_reach(), resident_bytes()); }

/// Ends with status 0 where an allocation beyond the limit fails as it should, and one below it does not.
[[noreturn]] void allocate_beyond_a_limit() {
  refuse_memory_beyond(1024 * kMega);
  refuse_memory_beyond(4096 * kMega);  // lifts nothing
  int status = 1;
  try {
    ::operator delete(::operator new(64 * kMega));
    ::operator delete(::operator new(2048 * kMega));
  } catch (const std::bad_alloc&) {
    status = memory_within_reach() <= 1100 * kMega ? 0 : 2;
  }
  std::_Exit(status);
}

TEST(Memory, BeyondALimitIsAnErrorOfOurs) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve more than any limit";
#else
  EXPECT_EXIT(allocate_beyond_a_limit(), testing::ExitedWithCode(0), "");
#endif
}

}  // namespace
}  // namespace clerestory
