// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance.h"

#include "tests/fuzz/target.h"
#include "tests/support/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clerestory;
  // Scenes include others, and arguments, that stand beside them.
  static const bool has_others = [] {
    test::write_text(fuzz::folder() / "part.rad", "m polygon top.1 0 0 9 0 0 0 1 0 0 1 1 0\n");
    test::write_text(fuzz::folder() / "circle.rad", "!xform -t 0 0 1 scene.rad\n");
    test::write_text(fuzz::folder() / "places.txt", "-t 1 0 0\n-rz 90 -t 0 1 0\n");
    return true;
  }();
  static_cast<void>(has_others);
  return fuzz::read_bytes(data, size, "scene.rad", [](const auto& path) { fuzz::check(io::read_radiance(path)); });
}
