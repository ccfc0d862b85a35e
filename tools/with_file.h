// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "mesh/error.h"

namespace clerestory::tools {

/// Calls, and names the user's file in an InputError that names none: what computes knows of no files.
template <class Call>
auto with_file(const std::filesystem::path& file, const Call& call) {
  try {
    return call();
  } catch (const InputError& error) {
    if (!error.file().empty()) throw;
    throw InputError(file.string(), 0, error.problem(), error.hint());
  }
}

}  // namespace clerestory::tools
