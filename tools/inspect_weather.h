// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tools/options.h"

namespace clerestory::tools {

/// `clerestory inspect` of a weather file: what is in it, and with --out the picture of its year. Returns the exit status; throws InputError
/// and MachineError.
int inspect_weather(const Options& options);

}  // namespace clerestory::tools
