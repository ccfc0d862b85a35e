// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

#include <cstddef>
#include <memory>

namespace clerestory::lighting {

/// Tells the thread sanitizer of an order that it cannot see: what came before signal() is there after see().
class KnownOrder {
 public:
#if defined(__SANITIZE_THREAD__)
  void signal() { __tsan_release(this); }
  void see() { __tsan_acquire(this); }
#else
  void signal() {}
  void see() {}
#endif
};

/// Calls body(i) for every i in [0, count), in any order and on any thread. The one door to threading: bodies write only what
/// belongs to i, so that results do not depend on the number of threads.
template <class Body>
void parallel_for(std::size_t count, const Body& body, std::size_t grain = 1) {
  KnownOrder begun;  // TBB's own order, whose library Debian does not compile with the sanitizer
  KnownOrder ended;
  begun.signal();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      begun.see();
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                      ended.signal();
                    });
  ended.see();
}

/// Caps the threads of the whole process for as long as it lives.
using ThreadLimit = std::unique_ptr<tbb::global_control>;

inline ThreadLimit limit_threads(std::size_t threads) {
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}

}  // namespace clerestory::lighting
