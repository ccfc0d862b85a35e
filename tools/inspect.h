// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tools/options.h"

namespace clerestory::tools {

/// `clerestory inspect`: what is in a model or photometric file, as text or JSON on stdout. Returns the exit status: kInputAtFault where it is to be strict
/// and something cannot be mended. Throws InputError, MachineError, Interrupted, and what the standard library throws.
int inspect(const Options& options);

}  // namespace clerestory::tools
