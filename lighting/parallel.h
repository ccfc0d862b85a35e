// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <memory>

#if defined(__SANITIZE_THREAD__)
#include <array>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#endif

namespace clerestory::lighting {

#if defined(__SANITIZE_THREAD__)

/// In place of TBB, whose locks the thread sanitizer does not see as Debian compiles it: threads whose order it does see, and that share
/// nothing but the number of the next item.
template <class Body>
void for_blocks(std::size_t count, std::size_t grain, const Body& body) {
  std::atomic<std::size_t> next{0};
  std::mutex failing;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (std::size_t first = next.fetch_add(grain, std::memory_order_relaxed); first < count;
           first = next.fetch_add(grain, std::memory_order_relaxed)) {
        body(first, count - first < grain ? count : first + grain);
      }
    } catch (...) {
      const std::lock_guard lock(failing);
      failure = std::current_exception();
    }
  };
  {
    std::array<std::jthread, 2> others;
    if (count > grain) {
      for (std::jthread& other : others) other = std::jthread(work);
    }
    work();
  }
  if (failure) std::rethrow_exception(failure);
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
