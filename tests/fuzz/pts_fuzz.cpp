// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/pts.h"

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clerestory;
  return fuzz::read_bytes(data, size, "file.pts", [](const auto& path) { io::read_pts(path); });
}
