// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tools/options.h"

namespace clerestory::tools {

/// `clerestory illuminance`: illuminance under the sky and the lamps of the study. Returns the exit status; throws as
/// answer() does.
int illuminance(const Options& options);

}  // namespace clerestory::tools
