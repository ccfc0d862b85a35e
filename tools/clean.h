// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tools/options.h"

namespace clerestory::tools {

/// `clerestory clean`: writes the mended model, with the report of what was mended and a marker at each defect beside it. Returns the exit
/// status. Throws InputError, MachineError, Interrupted, and what the standard library throws.
int clean(const Options& options);

}  // namespace clerestory::tools
