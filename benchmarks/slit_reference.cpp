// SPDX-License-Identifier: GPL-3.0-or-later
// The reference of the room that is lit through a slit (tests/validation/slit_rooms.h): illuminance and standard error [lx] of each sensor.
//   slit_reference [paths a sensor, 6000000]
#include <fmt/format.h>

#include <cstdlib>

#include "tests/support/path_tracer.h"
#include "tests/support/traced_scene.h"
#include "tests/validation/slit_rooms.h"

using namespace clerestory;

int main(int argc, char** argv) {
  const std::size_t paths = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 6'000'000;
  const lighting::Study study = test::rooms_with_short_wall({.short_m = test::kSlit_m});
  const lighting::GridRequest& grid = study.grids.at(0);
  for (const test::Traced& sensor :
       test::trace_illuminance(test::traced_scene(study), grid.points, grid.normals, {.paths = paths, .seed = 77}))
    fmt::print("    {{{:.4f}, {:.4f}}},\n", sensor.illuminance_lux, sensor.standard_error_lux);
  return 0;
}
