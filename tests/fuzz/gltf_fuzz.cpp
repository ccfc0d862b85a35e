// SPDX-License-Identifier: GPL-3.0-or-later
// Through the door of the child process, with limits that a hostile file soon meets.
#include "io/gltf.h"

#include "io/child_process.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clerestory;
  constexpr io::ChildLimits kNarrow{.cpu_s = 2, .wall_s = 20, .memory_bytes = std::uint64_t{1} << 30};
  const bool is_binary = size >= 4 && io::is_glb({reinterpret_cast<const char*>(data), 4});
  return fuzz::read_bytes(data, size, is_binary ? "model.glb" : "model.gltf", [&](const auto& path) {
    fuzz::check(io::read_in_child(path, {}, &io::import_gltf, kNarrow));
  });
}
