// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/epw.h"

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clerestory;
  const char* name = size > 0 && data[0] == 'p' ? "file.wea" : "file.epw";
  return fuzz::read_bytes(data, size, name, [](const auto& path) { io::read_weather(path); });
}
