// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/standard_output.h"

#include <cstdio>

#include "mesh/error.h"

namespace clerestory::tools {

void print(const std::string& text, std::string_view consolation) {
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!whole) throw MachineError("standard output: cannot be written" + std::string(consolation));
}

}  // namespace clerestory::tools
