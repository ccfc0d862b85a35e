// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/sdf.h"

#include "tests/fuzz/target.h"
#include "tests/support/scratch_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clerestory;
  // Worlds include models, and name meshes, that stand beside them.
  static const bool has_others = [] {
    std::filesystem::create_directories(fuzz::folder() / "part");
    test::write_text(
        fuzz::folder() / "part" / "model.sdf",
        "<sdf><model name='p'><pose>1 0 0 0 0 0</pose><link><visual><geometry><mesh><uri>part.obj</uri></mesh>"
        "</geometry></visual></link><include><uri>scene</uri></include></model></sdf>");
    for (const auto& place : {fuzz::folder(), fuzz::folder() / "part"})
      test::write_text(place / "part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 2\nusemtl m\nf 1 2 3\n");
    return true;
  }();
  static_cast<void>(has_others);
  return fuzz::read_bytes(data, size, "scene.sdf", [](const auto& path) { fuzz::check(io::read_sdf(path)); });
}
