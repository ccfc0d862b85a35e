// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tools/options.h"

namespace clerestory::tools {

/// `clerestory daylight`: daylight factors under the CIE overcast sky. Returns the exit status; throws as answer()
/// does.
int daylight(const Options& options);

}  // namespace clerestory::tools
