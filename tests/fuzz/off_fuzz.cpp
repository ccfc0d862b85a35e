// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/off.h"

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clerestory;
  return fuzz::read_bytes(data, size, "model.off", [](const auto& path) { fuzz::check(io::read_off(path)); });
}
