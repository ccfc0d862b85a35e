// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tools/options.h"

namespace clerestory::tools {

/// `clerestory sense`: grids from a stored solution, without solving. Returns the exit status. Throws as answer().
int sense(const Options& options);

}  // namespace clerestory::tools
