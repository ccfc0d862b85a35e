// SPDX-License-Identifier: GPL-3.0-or-later
// A room lit by globes of many facets, none of which matters alone: clusters of them, and what few rays tell of them, must add up to all of
// their light.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/support/shapes.h"
#include "tests/support/traced_scene.h"
#include "tests/validation/statistics.h"
#include "tests/validation/studies.h"

namespace clerestory::test {
namespace {

constexpr double kEmission_lm_m2 = 15000.0;

/// Walls of reflectance 0.5 around four black globes that hang over two tables.
lighting::Study study() {
  mesh::Model model = support::box_room(6, 5, 2.8);
  support::add_box(model, {0.8, 1.0, 0.72}, {2.4, 1.8, 0.75}, {"desk", "desk"});
  support::add_box(model, {3.4, 3.0, 0.72}, {5.0, 3.8, 0.75}, {"desk", "desk"});
  for (const double x : {1.5, 4.5}) {
    for (const double y : {1.5, 3.5}) support::add_globe(model, {x, y, 2.3}, 0.15, 32, 16, {"globe", "globe"});
  }
  lighting::Study study = grey_study(std::move(model), 0.5);
  lighting::Material& globe = material(study, "globe");
  globe.front.reflectance = globe.back.reflectance = lighting::Spectrum{0.0F};
  shine(globe, kEmission_lm_m2);
  return study;
}

TEST(GlobeLamps, GiveAllOfTheirLight) {
  lighting::Study globes = study();
  add_sensors(globes, cell_centres({0.2, 0.2, 0.8}, 5.6, 4.6, 5), {0, 0, 1});
  globes.accuracy.target = 0.02;
  const lighting::Results results = answer(globes);
  std::cout << "[ FIGURES  ] globe lamps: balance off by " << 100 * results.energy.residual << " %\n";
  EXPECT_LE(std::abs(results.energy.residual), 0.01);

  const Comparison c = compare(results.grids.at(0), traced_reference(globes, 65'536));
  print("globe lamps", c);
  EXPECT_TRUE(results.accuracy_met);
  EXPECT_LE(std::abs(c.bias), 0.01);
  EXPECT_LE(c.rms, 0.025);  // the noise of the path tracer included
}

}  // namespace
}  // namespace clerestory::test
