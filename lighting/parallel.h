// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <memory>

namespace clerestory::lighting {

/// Calls body(i) for every i in [0, count), in any order and on any thread. The one door to threading: bodies write only what
/// belongs to i, so that results do not depend on the number of threads.
template <class Body>
void parallel_for(std::size_t count, const Body& body, std::size_t grain = 1) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
                    });
}

/// Caps the threads of the whole process for as long as it lives.
using ThreadLimit = std::unique_ptr<tbb::global_control>;

inline ThreadLimit limit_threads(std::size_t threads) {
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}

}  // namespace clerestory::lighting
