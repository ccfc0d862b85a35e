// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tools/options.h"

namespace clerestory::tools {

/// `clerestory mesh`: the elements of a study and its lines of discontinuity. Returns the exit status.
/// Throws InputError, MachineError, Interrupted, and what the standard library throws.
int mesh(const Options& options);

}  // namespace clerestory::tools
