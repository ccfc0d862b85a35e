// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/places.h"

#include <cstdlib>

namespace clerestory::test {

std::filesystem::path source_dir() { return CLERESTORY_SOURCE_DIR; }

std::filesystem::path samples_dir() { return source_dir() / "samples"; }

std::filesystem::path validation_dir() {
  const char* set = std::getenv("CLERESTORY_VALIDATION_DIR");
  return set && *set ? std::filesystem::path(set) : source_dir().parent_path() / "shared" / "validation";
}

std::filesystem::path shared_data_dir() { return validation_dir().parent_path() / "data"; }

}  // namespace clerestory::test
