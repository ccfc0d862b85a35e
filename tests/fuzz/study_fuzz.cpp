// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/study_file.h"
#include "tests/fuzz/target.h"
#include "tests/support/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clerestory;
  // A study has its model and its sensors beside it.
  static const bool has_model = [] {
    test::write_text(fuzz::folder() / "room.obj",
                     "v 0 0 0\nv 4 0 0\nv 0 4 3\nusemtl wall\nf 1 2 3\nusemtl floor\nf 3 2 1\n");
    test::write_text(fuzz::folder() / "desk.pts", "1 1 1 0 0 1\n");
    return true;
  }();
  static_cast<void>(has_model);
  return fuzz::read_bytes(data, size, "study.toml", [](const auto& path) { io::read_study(path); });
}
