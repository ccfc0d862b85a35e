// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/eulumdat.h"

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clerestory;
  return fuzz::read_bytes(data, size, "file.ldt", [](const auto& path) { lighting::web_of(io::read_eulumdat(path)); });
}
