// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <memory>

#if defined(__SANITIZE_THREAD__)
#include <algorithm>
#include <array>
#include <exception>
#include <thread>
#include <vector>
#endif

namespace clerestory::lighting {

#if defined(__SANITIZE_THREAD__)

/// In place of TBB, whose locks the thread sanitizer does not see as Debian compiles it: three threads that take turns at the blocks, so that
/// each has some, and share nothing.
template <class Body>
void for_blocks(std::size_t count, std::size_t grain, const Body& body) {
  constexpr std::size_t kThreads = 3;
  std::array<std::exception_ptr, kThreads> failures;
  const auto work = [&](std::size_t own) {
    try {
      for (std::size_t first = own * grain; first < count; first += kThreads * grain)
        body(first, std::min(count, first + grain));
    } catch (...) {
      failures[own] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t own = 1; own < kThreads && own * grain < count; ++own) others.emplace_back(work, own);
    work(0);
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

#else

/// Calls body(begin, end) for parts of [0, count) that cover it, of `grain` items or more.
template <class Body>
void for_blocks(std::size_t count, std::size_t grain, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
}

#endif

/// Calls body(i) for every i in [0, count), in any order and on any thread. The one door to threading: bodies write only what
/// belongs to i, so that results do not depend on the number of threads.
template <class Body>
void parallel_for(std::size_t count, const Body& body, std::size_t grain = 1) {
  for_blocks(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) body(i);
  });
}

/// Caps the threads of the whole process for as long as it lives.
using ThreadLimit = std::unique_ptr<tbb::global_control>;

inline ThreadLimit limit_threads(std::size_t threads) {
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}

}  // namespace clerestory::lighting
