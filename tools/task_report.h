// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "lighting/results.h"

namespace clerestory::tools {

/// What is told at the terminal of luminaires, observers and tasks by EN 12464-1, an empty line behind each; nothing where there are none.
std::string task_report(const lighting::Results& results);

}  // namespace clerestory::tools
