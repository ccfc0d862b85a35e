// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <string>

#include "tools/exit_status.h"

namespace clerestory::tools {

/// What an error means to the user.
struct Failure {
  ExitStatus status;
  std::string line;  ///< what is wrong and what to do, in one line without control characters
};

/// Finds the exit status and the words for an error.
Failure describe(const std::exception& error);

}  // namespace clerestory::tools
