// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace clerestory {

/// Memory that this process holds [bytes].
std::uint64_t resident_bytes();

/// Memory that this process could hold before the system ends it or refuses more [bytes]: what it holds already and what the machine has
/// left, or what its control group and its own limits (ulimit) allow, if that is less.
std::uint64_t memory_within_reach();

/// Lets allocations fail that go beyond so much memory [bytes], so that what cannot be had is an error of ours (std::bad_alloc) and not the
/// end of the process. Never lifts a limit. Does nothing where more than that is reserved already, as sanitizers do.
void refuse_memory_beyond(std::uint64_t bytes);

}  // namespace clerestory
